#include "plot/picture_sheet.h"

#include <algorithm>

#include "plot/axis_drawing.h"
#include "plot/canvas.h"

namespace stilb::plot {
namespace {

constexpr double kUnitsPerPixel = 0.5;  // a PNG has two pixels to the unit
constexpr double kGap = 4, kLabel = 14;
constexpr double kTextSize = 8;

PixelImage image_of(const io::Picture& picture, const io::ToneCurve& curve) {
    PixelImage image{picture.width, picture.height, {}};
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
    Canvas canvas(path, kGap + static_cast<double>(across) * (width + kGap),
                  kGap + static_cast<double>(down) * (height + kLabel));
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const PageRectangle place{kGap + static_cast<double>(i % columns) * (width + kGap),
                                  kGap + static_cast<double>(i / columns) * (height + kLabel), width, height};
        canvas.image(place, image_of(pictures[i].picture, curve));
        canvas.text({place.center().x, place.bottom() + kLabel - 4}, pictures[i].label,
                    {.size = kTextSize, .colour = kInk, .horizontal = HorizontalPart::center});
    }
    canvas.save();
}

}  // namespace stilb::plot
