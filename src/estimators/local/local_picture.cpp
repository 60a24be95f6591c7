#include "estimators/local/local_picture.h"

#include "estimators/local/light_path_reception.h"

namespace stilb::estimators {
namespace {

/// Samples of direct light at each sub-point where lamps may be partly hidden.
constexpr std::uint64_t kDirectSamples = 2;

class LightPathPicture final : public LocalPicture {
  public:
    LightPathPicture(const LocalTransport& transport, const Problem& problem)
        : sub_points_(transport, problem, kDirectSamples), reception_(transport, problem, sub_points_) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<LightPathPass>(*this, pass);
    }

  private:
    class LightPathPass final : public PicturePass {
      public:
        LightPathPass(const LightPathPicture& picture, const Pass& pass)
            : picture_(picture), pass_(pass), pool_(picture.reception_.trace(pass)) {}

        void sample(const PixelBlock& block, Tally& sums) const override {
            const std::vector<SubPointPacket> packets = picture_.sub_points_.of_block(block, pass_, sums);
            picture_.reception_.receive(packets, {block.left, block.top}, pool_, pass_, sums);
        }

      private:
        const LightPathPicture& picture_;
        Pass pass_;
        NearNodePool pool_;
    };

    SubPoints sub_points_;
    LightPathReception reception_;
};

}  // namespace

std::unique_ptr<const LocalPicture> make_local_picture(const LocalTransport& transport,
                                                       const Problem& problem) {
    return std::make_unique<LightPathPicture>(transport, problem);
}

}  // namespace stilb::estimators
