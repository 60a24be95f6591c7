// Luminous intensity distributions as IES files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/photometry/photometry_file.h"

namespace stilb::io {

std::string to_ies(const PhotometricSolid::Grid& grid, std::string_view luminaire) {
    constexpr int kTypeC = 1, kMetres = 2;
    const std::size_t rings = grid.polar_deg.size();
    std::string text = fmt::format("IESNA:LM-63-2002\n[LUMINAIRE] {}\nTILT=NONE\n", luminaire);
    text += fmt::format("1 -1 1 {} {} {} {} 0 0 0\n1 1 0\n", rings, grid.planes_deg.size(), kTypeC, kMetres);
    text += fmt::format("{}\n{}\n", fmt::join(grid.polar_deg, "\n"), fmt::join(grid.planes_deg, "\n"));
    text += fmt::format("{}\n", fmt::join(grid.intensity_cd, "\n"));
    return text;
}

}  // namespace stilb::io
