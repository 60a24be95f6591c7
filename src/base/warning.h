// Warnings: sentences for people, each with a kind for programs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stilb {

/// What a warning is about. Programs filter by it: sentences may change.
enum class WarningKind : std::uint8_t {
    file,         ///< contents that a reader has changed or left out
    no_light,     ///< a scene without lamps
    units,        ///< sizes that suggest another unit
    openings,     ///< luminaires whose openings do not fit
    precision,    ///< coordinates that are too far from the origin
    holes,        ///< closed surfaces with open edges
    overlaps,     ///< surfaces in one place
    lamps,        ///< objects that are lamps by mistake
    placement,    ///< sensors and lights on the wrong side of a surface
    facing,       ///< sensors and lights that are turned away
    reach,        ///< sensors that no light reaches
    unlit,        ///< objects that no light reaches
    absorption,   ///< surfaces that absorb nearly nothing
    method,       ///< light that the method cannot compute
    patches,      ///< patches that are too coarse
    rare_light,   ///< light that few samples have found
    glare,        ///< lamps that a rating of glare cannot rate
    first_look,   ///< lamps that are no part of the scene
    missing_view  ///< a picture that the report lacks
};

/// As JSON and Python have them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 19> kWarningKindNames{
    "file",    "no-light",   "units",  "openings",   "precision",   "holes",      "overlaps",
    "lamps",   "placement",  "facing", "reach",      "unlit",       "absorption", "method",
    "patches", "rare-light", "glare",  "first-look", "missing-view"};

static_assert(kWarningKindNames.size() == static_cast<std::size_t>(WarningKind::missing_view) + 1);

struct Warning {
    WarningKind kind = WarningKind::file;
    std::string text;

    Warning(std::string sentence) : text(std::move(sentence)) {}
    Warning(WarningKind of, std::string sentence) : kind(of), text(std::move(sentence)) {}

    std::string_view kind_name() const { return kWarningKindNames[static_cast<std::size_t>(kind)]; }
    bool operator==(const Warning&) const = default;
    friend bool operator==(const Warning& warning, std::string_view sentence) {
        return warning.text == sentence;
    }
};

/// For searches.
inline auto is_of(WarningKind kind) {
    return [kind](const Warning& warning) { return warning.kind == kind; };
}

/// Adds sentences of one kind.
inline void add_warnings(WarningKind kind, std::vector<std::string> sentences,
                         std::vector<Warning>& warnings) {
    for (std::string& sentence : sentences) warnings.emplace_back(kind, std::move(sentence));
}

inline std::vector<std::string_view> kind_names_of(std::span<const Warning> warnings) {
    std::vector<std::string_view> names;
    for (const Warning& warning : warnings) names.push_back(warning.kind_name());
    return names;
}

inline std::vector<std::string> texts_of(std::span<const Warning> warnings) {
    std::vector<std::string> texts;
    for (const Warning& warning : warnings) texts.push_back(warning.text);
    return texts;
}

}  // namespace stilb
