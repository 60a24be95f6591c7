// The library. docs/library.md has an example.
#pragma once

#include "stilb/error.h"
#include "stilb/measure.h"
#include "stilb/options.h"
#include "stilb/render.h"
#include "stilb/scene.h"
#include "stilb/version.h"

namespace stilb {

using namespace api;

}  // namespace stilb
