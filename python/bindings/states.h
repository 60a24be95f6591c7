// The values of results that Python's pickle stores.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "api/stored.h"
#include "stilb/measure.h"
#include "stilb/render.h"

namespace stilb::api::bindings {

/// The elements of a list, as they lie in memory.
template <typename Element>
nanobind::bytes bytes_of(const std::vector<Element>& list) {
    static_assert(std::is_trivially_copyable_v<Element>);
    return nanobind::bytes(list.data(), list.size() * sizeof(Element));
}

template <typename Element>
std::vector<Element> list_of_bytes(const nanobind::bytes& bytes) {
    std::vector<Element> list(bytes.size() / sizeof(Element));
    std::memcpy(list.data(), bytes.data(), list.size() * sizeof(Element));
    return list;
}

using EstimateState = std::array<double, 4>;
EstimateState state_of(const Estimate& estimate);
Estimate restored(const EstimateState& state);

using RequirementState = std::tuple<std::string, double, int, std::string>;
RequirementState state_of(const Requirement& requirement);
Requirement restored(const RequirementState& state);

using SummaryState =
    std::tuple<std::string, std::string, std::uint64_t, std::uint64_t, int, double, std::string, bool,
               std::optional<double>, double, std::vector<std::string>, std::vector<std::string>>;
SummaryState state_of(const Summary& summary);
Summary restored(const SummaryState& state);

/// Name, readings, statistics, replicates.
using ShareState = std::tuple<std::string, nanobind::bytes, std::array<EstimateState, 5>, nanobind::bytes>;
ShareState state_of(const LightShare& share);
LightShare restored(const ShareState& state);

/// Texts, columns and rows, readings, statistics, error, requirements, replicates, shares.
using SensorState =
    std::tuple<std::array<std::string, 4>, std::array<int, 2>, nanobind::bytes, std::array<EstimateState, 5>,
               double, std::vector<RequirementState>, nanobind::bytes, std::vector<ShareState>>;
SensorState state_of(const SensorResult& result);
SensorResult restored(const SensorState& state);

using LightSceneState = std::tuple<std::string, std::vector<SensorResult>, std::optional<double>>;
LightSceneState state_of(const LightSceneResult& result);
LightSceneResult restored(const LightSceneState& state);

using ResultState =
    std::tuple<SummaryState, std::vector<SensorResult>, double, std::string, std::vector<LightSceneResult>>;
ResultState state_of(const Result& result);
Result restored(const ResultState& state);

using PictureState = std::tuple<SummaryState, nanobind::bytes, std::array<double, 3>, std::array<double, 3>>;
PictureState state_of(const Picture& picture);
Picture restored(const PictureState& state);

/// Lets pickle and copy have the objects of a class.
template <typename Class, typename... Base>
void add_state(nanobind::class_<Class, Base...>& type) {
    using State = decltype(state_of(std::declval<const Class&>()));
    type.def(
            "__getstate__", [](const Class& object) { return state_of(object); },
            nanobind::sig("def __getstate__(self) -> object"))
        .def(
            "__setstate__", [](Class& object, const State& state) { new (&object) Class(restored(state)); },
            nanobind::sig("def __setstate__(self, state: object, /) -> None"));
}

}  // namespace stilb::api::bindings
