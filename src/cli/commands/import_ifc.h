// Buildings in IFC, which the Python package imports.
#pragma once

#include <string>

namespace stilb::cli {

struct IfcRequest {
    std::string file, output;
    std::string reflectances;  ///< a table for materials; may be empty
};

/// Runs `python3 -m stilb.ifc`, of the Python beside this program where there is one. Returns its exit code.
/// Throws InputError where there is no Python with the package and its extra for IFC.
int import_ifc(const IfcRequest& request);

}  // namespace stilb::cli
