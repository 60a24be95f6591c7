// Transforms as the program xform and the arguments of data files and instances state them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geometry/transform.h"

namespace stilb::io::radiance {

/// The effect of xform, one of several where it makes an array, or of several xforms, one inside another.
struct Xform {
    geometry::Transform transform;
    double scale = 1;           ///< of lengths, above 0
    bool is_mirrored = false;   ///< by the transform
    bool is_inverted = false;   ///< fronts become backs
    std::string modifier = {};  ///< that surfaces get instead of their own; empty for their own
    std::string prefix = {};    ///< of their names, with its dot

    /// First `inner`, then this.
    Xform after(const Xform& inner) const;
};

/// Reads transforms ("-t 1 0 0 -rz 90 -i 2 -s 0.5 ...") from the front of the arguments. Returns how many
/// arguments belong to them. Throws InputError for a transform whose numbers are missing or wrong.
std::size_t read_transforms(std::span<const std::string> arguments, Xform& result);

/// Arguments of xform: all its copies, and its files.
struct XformCommand {
    std::vector<Xform> copies;
    std::vector<std::string> files;
};
/// `read_file` gives the content of the argument file of -f; the copies are at most `most`. Throws InputError
/// without a place.
XformCommand read_xform(const std::vector<std::string>& arguments,
                        const std::function<std::string(const std::string&)>& read_file, std::size_t most);

}  // namespace stilb::io::radiance
