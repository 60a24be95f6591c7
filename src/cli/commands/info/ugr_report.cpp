#include "cli/commands/info/ugr_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stilb/error.h"
#include "transport/glare/ugr_table.h"

namespace stilb::cli {
namespace {

using Json = InfoReport;
using transport::kUgrReflectances;
using transport::kUgrRooms;

/// The spacing of the luminaires in units of H: data sheets use the first, CIE 190 the second.
constexpr double kUsualSpacing = 0.25, kWideSpacing = 1;
constexpr double kReferenceFlux_lm = 1000;

Json columns_json(const transport::UgrColumns& columns) {
    Json rows = Json::array();
    for (const auto& row : columns) rows.push_back(row);
    return rows;
}

Json table_json(const PhotometricSolid& solid, const lights::Opening& opening, double spacing) {
    const transport::UgrTable table = transport::ugr_table(solid, opening, spacing);
    return {{"spacing_h", spacing},
            {"crosswise", columns_json(table.crosswise)},
            {"endwise", columns_json(table.endwise)}};
}

/// A rating in a column of six characters; "-" where the eye sees no light.
std::string rating_text(const Json& rating) {
    const double value = rating.is_null() ? NAN : rating.get<double>();
    return std::isfinite(value) ? fmt::format("{:6.1f}", value) : fmt::format("{:>6}", "-");
}

std::string row_text(const Json& table, std::size_t room) {
    std::string line = fmt::format("    {:>3} {:>3} ", fmt::format("{}H", kUgrRooms[room].across),
                                   fmt::format("{}H", kUgrRooms[room].along));
    for (const char* const orientation : {"crosswise", "endwise"}) {
        line += "  ";
        for (const Json& rating : table.at(orientation).at(room)) line += rating_text(rating);
    }
    return line + '\n';
}

std::string reflectances_text(std::string_view name, double transport::OfSurfaces::*member) {
    std::string line = fmt::format("    {:<8}", name);
    for (int orientation = 0; orientation < 2; ++orientation) {
        line += "  ";
        for (const transport::OfSurfaces& of : kUgrReflectances)
            line += fmt::format("{:6.0f}", 100 * of.*member);
    }
    return line + '\n';
}

/// By how much the ratings of another spacing differ, over all rooms and reflectances.
std::string difference_text(const Json& usual, const Json& wide, const char* orientation) {
    double least = 0, most = 0;
    bool is_first = true;
    for (std::size_t room = 0; room < kUgrRooms.size(); ++room) {
        for (std::size_t s = 0; s < kUgrReflectances.size(); ++s) {
            const Json &a = usual.at(orientation).at(room).at(s), &b = wide.at(orientation).at(room).at(s);
            const double difference = b.get<double>() - a.get<double>();
            if (!std::isfinite(difference)) continue;
            least = is_first ? difference : std::min(least, difference);
            most = is_first ? difference : std::max(most, difference);
            is_first = false;
        }
    }
    return fmt::format("{:+.1f} to {:+.1f}", least, most);
}

}  // namespace

InfoReport ugr_json(const io::PhotometryFile& file, const PhotometricSolid& solid, const std::string& path) {
    const lights::Opening opening = lights::Opening::of_signed(file.opening_m);
    if (opening.is_point()) {
        throw InputError(
            "states no luminous opening: its length, width and height are 0. UGR needs the luminance of the "
            "opening: give the file the size of its luminous area.",
            {path});
    }
    const double flux_lm = file.lamp_flux_lm > 0 ? file.lamp_flux_lm : solid.flux_lm();
    Json rooms = Json::array(), reflectances = Json::array();
    for (const auto& [across, along] : kUgrRooms) rooms.push_back({across, along});
    for (const auto& [ceiling, walls, floor] : kUgrReflectances)
        reflectances.push_back({ceiling, walls, floor});
    return {
        {"flux_lm", flux_lm},
        {"correction", 8 * std::log10(flux_lm / kReferenceFlux_lm)},
        {"rooms_h", rooms},
        {"reflectances", reflectances},
        {"tables", {table_json(solid, opening, kUsualSpacing), table_json(solid, opening, kWideSpacing)}}};
}

std::string ugr_text(const InfoReport& ugr) {
    const Json &usual = ugr.at("tables").at(0), &wide = ugr.at("tables").at(1);
    std::string text = fmt::format(
        "\n    UGR for {:.5g} lm (uncorrected, for 1000 lm: {:.1f} less), luminaires {:g} H apart\n"
        "{:>34}{:>31}\n",
        ugr.at("flux_lm").get<double>(), ugr.at("correction").get<double>(), kUsualSpacing, "crosswise",
        "endwise");
    text += reflectances_text("ceiling", &transport::OfSurfaces::ceiling) +
            reflectances_text("walls", &transport::OfSurfaces::walls) +
            reflectances_text("floor", &transport::OfSurfaces::floor) + "      X   Y\n";
    for (std::size_t room = 0; room < kUgrRooms.size(); ++room) text += row_text(usual, room);
    return text + fmt::format("    With luminaires {:g} H apart: {} crosswise, {} endwise", kWideSpacing,
                              difference_text(usual, wide, "crosswise"),
                              difference_text(usual, wide, "endwise"));
}

}  // namespace stilb::cli
