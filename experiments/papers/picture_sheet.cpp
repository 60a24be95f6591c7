#include "papers/picture_sheet.h"

#include <algorithm>

#include "plot/axis.h"
#include "plot/canvas.h"

namespace stilb::papers {
namespace {

constexpr double kUnitsPerPixel = 0.5;  // a PNG has two pixels to the unit
constexpr double kPageGap = 4, kLabel = 14;
constexpr double kTextSize = 8;

plot::PixelImage image_of(const io::Picture& picture, const io::ToneCurve& curve) {
    plot::PixelImage image{picture.width, picture.height, {}};
    for (const auto& rgb : picture.rgb_cd_m2) {
        const auto [red, green, blue] = curve.srgb(rgb);
        image.pixels.push_back(std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | std::uint32_t{blue});
    }
    return image;
}

}  // namespace

void draw_picture_sheet(const std::vector<LabelledPicture>& pictures, std::size_t columns,
                        const io::ToneCurve& curve, const std::filesystem::path& path) {
    const double width = kUnitsPerPixel * pictures.front().picture.width;
    const double height = kUnitsPerPixel * pictures.front().picture.height;
    const std::size_t across = std::min(columns, pictures.size());
    const std::size_t down = (pictures.size() + columns - 1) / columns;
    plot::Canvas canvas(path, kPageGap + static_cast<double>(across) * (width + kPageGap),
                        kPageGap + static_cast<double>(down) * (height + kLabel));
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::size_t row = i / columns, column = i % columns;
        const plot::PageRectangle place{kPageGap + static_cast<double>(column) * (width + kPageGap),
                                        kPageGap + static_cast<double>(row) * (height + kLabel), width,
                                        height};
        canvas.image(place, image_of(pictures[i].picture, curve));
        canvas.text({place.center().x, place.bottom() + kLabel - 4}, pictures[i].label,
                    {.size = kTextSize, .colour = plot::kInk, .horizontal = plot::HorizontalPart::center});
    }
    canvas.save();
}

}  // namespace stilb::papers
