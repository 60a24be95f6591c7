#include "bindings/states.h"

#include <utility>

namespace stilb::api::bindings {

namespace nb = nanobind;

EstimateState state_of(const Estimate& estimate) {
    return {estimate.value, estimate.standard_error, estimate.lower, estimate.upper};
}

Estimate restored(const EstimateState& state) { return {state[0], state[1], state[2], state[3]}; }

RequirementState state_of(const Requirement& requirement) {
    return {requirement.key, requirement.limit, static_cast<int>(requirement.verdict), requirement.reason};
}

Requirement restored(const RequirementState& state) {
    const auto& [key, limit, verdict, reason] = state;
    return {key, limit, static_cast<Verdict>(verdict), reason};
}

SummaryState state_of(const Summary& s) {
    return {s.method,          s.technique,      s.seed,     s.samples,
            s.replicates,      s.elapsed_s,      s.stopped,  s.converged,
            s.requested_error, s.attained_error, s.warnings, s.warning_kinds};
}

Summary restored(const SummaryState& state) { return std::make_from_tuple<Summary>(state); }

ShareState state_of(const LightShare& share) {
    return {share.name,
            bytes_of(share.readings),
            {state_of(share.mean), state_of(share.minimum), state_of(share.maximum),
             state_of(share.uniformity), state_of(share.diversity)},
            bytes_of(share.replicates)};
}

LightShare restored(const ShareState& state) {
    const auto& [name, readings, statistics, replicates] = state;
    return {name,
            list_of_bytes<Estimate>(readings),
            restored(statistics[0]),
            restored(statistics[1]),
            restored(statistics[2]),
            restored(statistics[3]),
            restored(statistics[4]),
            list_of_bytes<double>(replicates)};
}

LightSceneState state_of(const LightSceneResult& result) {
    return {result.name, result.sensors, result.power_w};
}

LightSceneResult restored(const LightSceneState& state) {
    return std::make_from_tuple<LightSceneResult>(state);
}

SensorState state_of(const SensorResult& result) {
    SensorState state{{result.name, result.type, result.quantity, result.unit},
                      result.count,
                      bytes_of(result.readings),
                      {state_of(result.mean), state_of(result.minimum), state_of(result.maximum),
                       state_of(result.uniformity), state_of(result.diversity)},
                      result.attained_error,
                      {},
                      bytes_of(result.replicates),
                      {}};
    for (const LightShare& share : result.shares)
        std::get<std::vector<ShareState>>(state).push_back(state_of(share));
    for (const Requirement& requirement : result.requirements)
        std::get<std::vector<RequirementState>>(state).push_back(state_of(requirement));
    return state;
}

SensorResult restored(const SensorState& state) {
    const auto& [texts, count, readings, statistics, error, requirements, replicates, shares] = state;
    SensorResult result{.name = texts[0],
                        .type = texts[1],
                        .quantity = texts[2],
                        .unit = texts[3],
                        .count = count,
                        .readings = list_of_bytes<Reading>(readings),
                        .mean = restored(statistics[0]),
                        .minimum = restored(statistics[1]),
                        .maximum = restored(statistics[2]),
                        .uniformity = restored(statistics[3]),
                        .attained_error = error,
                        .diversity = restored(statistics[4]),
                        .requirements = {},
                        .replicates = list_of_bytes<double>(replicates),
                        .shares = {}};
    for (const ShareState& share : shares) result.shares.push_back(restored(share));
    for (const RequirementState& requirement : requirements)
        result.requirements.push_back(restored(requirement));
    return result;
}

ResultState state_of(const Result& result) {
    return {state_of(static_cast<const Summary&>(result)), result.sensors, result.confidence, result.json(),
            result.light_scenes};
}

Result restored(const ResultState& state) {
    const auto& [summary, sensors, confidence, json, light_scenes] = state;
    return restored_result(restored(summary), sensors, confidence, json, light_scenes);
}

namespace {

std::array<double, 3> bands_of(const Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }
Rgb rgb_of(const std::array<double, 3>& bands) { return {{bands[0], bands[1], bands[2]}}; }

}  // namespace

PictureState state_of(const Picture& picture) {
    const StoredPicture kept = stored(picture);
    return {state_of(static_cast<const Summary&>(picture)), nb::bytes(kept.exr.data(), kept.exr.size()),
            bands_of(kept.warmest), bands_of(kept.coolest)};
}

Picture restored(const PictureState& state) {
    const auto& [summary, exr, warmest, coolest] = state;
    return restored_picture(restored(summary),
                            {std::string(exr.c_str(), exr.size()), rgb_of(warmest), rgb_of(coolest)});
}

}  // namespace stilb::api::bindings
