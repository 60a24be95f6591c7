// Tables of the Unified Glare Rating in the report of a luminaire file.
#pragma once

#include <string>

#include "cli/commands/info/info_report.h"
#include "io/photometry/photometry_file.h"

namespace stilb::cli {

/// The tables with the conditions that they hold for. Throws InputError, naming the file, where it states no
/// luminous opening.
InfoReport ugr_json(const io::PhotometryFile& file, const PhotometricSolid& solid, const std::string& path);
std::string ugr_text(const InfoReport& ugr);

}  // namespace stilb::cli
