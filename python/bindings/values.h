// Values of Python as values of scene files.
#pragma once

#include <nanobind/nanobind.h>

#include "stilb/scene.h"

namespace stilb::api::bindings {

/// A number, a text or a path, True or False, a sequence or an array, or a dictionary. `path`: the full name
/// of the key. Throws InputError for anything else.
Value value_of(nanobind::handle value, const std::string& path);
/// The entries of a dictionary.
Parameters parameters_of(const nanobind::dict& keys, const std::string& path);

}  // namespace stilb::api::bindings
