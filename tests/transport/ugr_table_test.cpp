// UGR tables against CIE's transfer factors, closed forms, and ratings worked out one luminaire at a time.
#include "transport/glare/ugr_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transport/glare/glare.h"

namespace stilb::transport {
namespace {

/// I = I0 cos gamma, or the file of a luminaire that shines `more` along C0 than along C90.
PhotometricSolid diffuse_solid(double peak_cd, double more = 0) {
    PhotometricSolid::Grid grid;
    for (int plane = 0; plane <= 360; plane += 15) grid.planes_deg.push_back(plane);
    for (int ring = 0; ring <= 180; ++ring) grid.polar_deg.push_back(ring);
    for (const double plane : grid.planes_deg) {
        for (const double ring : grid.polar_deg) {
            const double gamma = ring * kPi / 180, c = plane * kPi / 180;
            grid.intensity_cd.push_back(std::max(0.0, peak_cd * std::cos(gamma)) *
                                        (1 + more * std::sin(gamma) * std::cos(c) * std::cos(c)));
        }
    }
    return PhotometricSolid(grid);
}

constexpr lights::Opening kPanelOpening{lights::Opening::Form::box, {0.6, 0.6, 0}};

std::size_t room_number(int across, int along) {
    const auto found = std::ranges::find_if(
        kUgrRooms, [&](const UgrRoom& room) { return room.across == across && room.along == along; });
    return static_cast<std::size_t>(found - kUgrRooms.begin());
}

/// Transfer factors of CIE 190, table 5: from floor, walls and ceiling to the walls.
TEST(UgrTable, HasTheTransferFactorsOfCie190) {
    struct Printed {
        UgrRoom room;
        std::size_t reflectances;
        double from_floor, from_walls, from_ceiling;
    };
    for (const Printed& printed : {Printed{{2, 2}, 0, 0.220, 0.422, 0.646},
                                   {{2, 12}, 1, 0.143, 0.156, 0.397},
                                   {{4, 8}, 0, 0.115, 0.211, 0.307},
                                   {{4, 8}, 2, 0.100, 0.187, 0.211},
                                   {{8, 4}, 3, 0.093, 0.104, 0.196},
                                   {{12, 8}, 4, 0.049, 0.059, 0.069}}) {
        const OfSurfaces& reflectances = kUgrReflectances[printed.reflectances];
        constexpr double rounding = 0.0005 + 1e-9;
        EXPECT_NEAR(indirect_share_of_walls(printed.room, reflectances, {.floor = 1}), printed.from_floor,
                    rounding);
        EXPECT_NEAR(indirect_share_of_walls(printed.room, reflectances, {.walls = 1}), printed.from_walls,
                    rounding);
        EXPECT_NEAR(indirect_share_of_walls(printed.room, reflectances, {.ceiling = 1}), printed.from_ceiling,
                    rounding);
    }
}

/// Of light that walls alone reflect, all others black: a geometric series of the walls' own factor.
TEST(UgrTable, AddsUpAllReflections) {
    constexpr double to_ceiling = 0.41525;  // squares of side 2 at distance 1 [configuration factors]
    const double walls_to_walls = 1 - 2 * (1 - to_ceiling) * 4 / 8;
    const double share = indirect_share_of_walls({2, 2}, {.walls = 0.5}, {.walls = 1});
    EXPECT_NEAR(share, 0.5 * walls_to_walls / (1 - 0.5 * walls_to_walls), 1e-5);
}

/// One luminaire in the smallest room with a spacing of its size: a rating by hand.
TEST(UgrTable, IsTheFormula) {
    const PhotometricSolid solid = diffuse_solid(1000);
    const UgrTable table = ugr_table(solid, kPanelOpening, 2);
    // The luminaire is in the middle: 1 H ahead, 1 H above the eye, at 45 degrees from its nadir.
    const double area_m2 = 0.36 * std::sqrt(0.5), distance_m = kUgrHeight_m * std::sqrt(2.0);
    const double luminance_cd_m2 = 1000 * std::sqrt(0.5) / area_m2;
    const double index = position_index({0, std::sqrt(0.5), std::sqrt(0.5)}, {0, 1, 0});
    const double glare =
        luminance_cd_m2 * luminance_cd_m2 * area_m2 / (distance_m * distance_m * index * index);
    // Into a square pyramid of half angle 45 degrees: the factor from the middle of a ceiling to its floor.
    const double on_floor = 4 / kPi * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
    const double walls_m2 = 8 * kUgrHeight_m * kUgrHeight_m;
    for (std::size_t s = 0; s < kUgrReflectances.size(); ++s) {
        const double share =
            indirect_share_of_walls({2, 2}, kUgrReflectances[s], {.walls = 1 - on_floor, .floor = on_floor});
        const double background = share * solid.flux_lm() / walls_m2 / kPi;
        const double rating = 8 * std::log10(0.25 * glare / background);
        EXPECT_NEAR(table.crosswise[0][s], rating, 0.002) << s;
        EXPECT_NEAR(table.endwise[0][s], rating, 0.002) << s;
    }
}

/// Close luminaires are a ceiling that shines all over: with half the usual spacing, little changes.
TEST(UgrTable, TendsToALimitForSmallSpacings) {
    const PhotometricSolid solid = diffuse_solid(1000);
    const UgrTable close = ugr_table(solid, kPanelOpening, 0.125),
                   usual = ugr_table(solid, kPanelOpening, 0.25);
    const std::size_t room = room_number(8, 12);
    EXPECT_NEAR(close.crosswise[room][0], usual.crosswise[room][0], 0.1);
}

/// The rating grows by 8 log10 of the flux; more flux does not change the differences between rooms.
TEST(UgrTable, GrowsWithTheFlux) {
    const UgrTable one = ugr_table(diffuse_solid(1000), kPanelOpening, 0.25);
    const UgrTable three = ugr_table(diffuse_solid(3000), kPanelOpening, 0.25);
    for (std::size_t room = 0; room < kUgrRooms.size(); ++room) {
        for (std::size_t s = 0; s < kUgrReflectances.size(); ++s)
            EXPECT_NEAR(three.endwise[room][s] - one.endwise[room][s], 8 * std::log10(3.0), 1e-9);
    }
}

/// The long side decides, whichever of C0 and C90 it lies along.
TEST(UgrTable, LooksAcrossTheLongSideOrAlongIt) {
    const PhotometricSolid bright_towards_c0 = diffuse_solid(1000, 1);
    lights::Opening opening{lights::Opening::Form::box, {0.2, 1.2, 0}};  // long along C90
    const UgrTable along_c90 = ugr_table(bright_towards_c0, opening, 0.25);
    std::swap(opening.extent_m.x, opening.extent_m.y);
    const UgrTable along_c0 = ugr_table(bright_towards_c0, opening, 0.25);
    const std::size_t room = room_number(4, 8);
    EXPECT_GT(along_c90.crosswise[room][0], along_c90.endwise[room][0] + 1) << "C0 points to the eye";
    EXPECT_NEAR(along_c0.endwise[room][0], along_c90.crosswise[room][0], 1e-9);
    EXPECT_NEAR(along_c0.crosswise[room][0], along_c90.endwise[room][0], 1e-9);
}

TEST(UgrTable, IsMinusInfinityWhereNoLightReachesTheEye) {
    PhotometricSolid::Grid up{lights::PhotometryType::C, {0}, {0, 90, 95, 180}, {0, 0, 100, 100}};
    const UgrTable table = ugr_table(PhotometricSolid(up), kPanelOpening, 0.25);
    EXPECT_TRUE(std::isinf(table.crosswise[0][0]) && table.crosswise[0][0] < 0);
}

}  // namespace
}  // namespace stilb::transport
