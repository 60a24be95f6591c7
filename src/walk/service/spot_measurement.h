// "Measure here": one reading by method auto, which has no patches, while somebody waits for it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "run/options.h"
#include "run/prepared_scene.h"
#include "scene/light_groups.h"
#include "scene/scene.h"
#include "sensors/measurand.h"

namespace stilb::walk {

struct SpotRequest {
    Measurand measurand;
    std::vector<LightFactor> factors;  ///< of groups of lights
};

/// {"kind": "illuminance", "position", "normal", "factors"} or {"kind": "luminance", "position", "direction",
/// "factors"}. Throws InputError with a sentence that the page can show.
SpotRequest read_spot_request(std::string_view json);

struct SpotReading {
    double value = 0;
    double half_width = 0;  ///< of the 95 % interval; of its wider side
    std::string_view unit;
    double time_s = 0;
};

std::string to_json(const SpotReading& reading);

/// The scene with its groups of lights dimmed and coloured, without those that are off. `factors`: of the
/// groups.
Scene with_factors(const Scene& scene, const LightGroups& groups, std::span<const Rgb> factors);

/// Measures in one scene, one reading at a time.
class SpotMeter {
  public:
    /// The scene must outlive this. Of the options, seed and threads count.
    SpotMeter(const Scene& scene, const RunOptions& options);

    /// To 1 %, or for two seconds; the first measurement also builds what rays need. Callable from several
    /// threads. Throws InputError where the scene cannot be measured so, or a group of lights has another
    /// name; Cancelled where there is no result in this time, where others are measuring, or after cancel().
    SpotReading measure(const SpotRequest& request);
    /// Ends what is being measured, and all that comes.
    void cancel() { is_cancelled_ = true; }

  private:
    const run::PreparedScene& lit_by(std::span<const LightFactor> factors);

    /// The scene by the light of the last request.
    struct Relit {
        std::vector<Rgb> factors;  ///< of the groups
        Scene scene;
        run::PreparedScene prepared;

        Relit(const run::PreparedScene& base, const LightGroups& groups, std::vector<Rgb> of_groups)
            : factors(std::move(of_groups)),
              scene(with_factors(base.scene(), groups, factors)),
              prepared(scene, base) {}
    };

    run::PreparedScene scene_;
    LightGroups groups_;
    std::unique_ptr<const Relit> relit_;
    RunOptions options_;
    std::timed_mutex mutex_;
    std::atomic<bool> is_cancelled_ = false;
};

}  // namespace stilb::walk
