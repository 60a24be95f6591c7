// The kinds of keys that sensors have in scene files, in addition to the numbers of base/field.h. Each type
// of sensor lists its own in fields(); the scene reader has one function for each kind of key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/vec.h"
#include "sensors/expression.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

// Deduction guides are written out: compilers before clang 17 deduce none for aggregates.

/// The limit of all sensors together: 10 million measurands take 0.8 gigabytes.
inline constexpr std::int64_t kMostReadings = 10'000'000;

/// [x, y, z] in m.
template <typename Owner>
struct PositionField {
    std::string_view key;
    Vec3 Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
PositionField(std::string_view, Vec3 Owner::*, std::string_view) -> PositionField<Owner>;

/// [x, y, z] in m, different from another position.
template <typename Owner>
struct TargetField {
    std::string_view key;
    Vec3 Owner::*member;
    Vec3 Owner::*position;
    std::string_view meaning;
};
template <typename Owner>
TargetField(std::string_view, Vec3 Owner::*, Vec3 Owner::*, std::string_view) -> TargetField<Owner>;

/// A unit vector, of any length but 0 in files. Value: Vec3, or std::optional<Vec3>.
template <typename Owner, typename Value>
struct DirectionField {
    std::string_view key;
    Value Owner::*member;
    std::string_view meaning;
    Presence presence = Presence::required;
    bool warns_of_length = true;  ///< where its length is far from 1
};
template <typename Owner, typename Value>
DirectionField(std::string_view, Value Owner::*, std::string_view) -> DirectionField<Owner, Value>;
template <typename Owner, typename Value>
DirectionField(std::string_view, Value Owner::*, std::string_view, Presence) -> DirectionField<Owner, Value>;
template <typename Owner, typename Value>
DirectionField(std::string_view, Value Owner::*, std::string_view, Presence, bool)
    -> DirectionField<Owner, Value>;

/// One position under "position", or many under "points".
template <typename Owner>
struct PositionsField {
    std::vector<Vec3> Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
PositionsField(std::vector<Vec3> Owner::*, std::string_view) -> PositionsField<Owner>;

/// Positions as in PositionsField, and one "normal" for all of them.
template <typename Owner>
struct MeasuringPointsField {
    std::vector<MeasuringPoint> Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
MeasuringPointsField(std::vector<MeasuringPoint> Owner::*, std::string_view) -> MeasuringPointsField<Owner>;

/// A "position", and one or many directions or targets from there.
template <typename Owner>
struct SightsField {
    std::vector<Measurand> Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
SightsField(std::vector<Measurand> Owner::*, std::string_view) -> SightsField<Owner>;

/// Positions of eyes, and for each of them one or many directions or targets; the normals are the directions.
template <typename Owner>
struct EyesField {
    std::vector<MeasuringPoint> Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
EyesField(std::vector<MeasuringPoint> Owner::*, std::string_view) -> EyesField<Owner>;

/// A parallelogram by "corner", "edge_u" and "edge_v".
template <typename Owner>
struct ParallelogramField {
    Vec3 Owner::*corner;
    Vec3 Owner::*edge_u;
    Vec3 Owner::*edge_v;
    std::string_view meaning;
};
template <typename Owner>
ParallelogramField(Vec3 Owner::*, Vec3 Owner::*, Vec3 Owner::*, std::string_view)
    -> ParallelogramField<Owner>;

/// The limit of the number of elements given by a pair of counts.
struct CountLimit {
    std::string_view form;  ///< "[nu, nv]"
    std::int64_t most_each, most;
    std::string_view things, where;
};

template <typename Owner>
struct CountsField {
    std::string_view key;
    std::array<int, 2> Owner::*member;
    CountLimit limit;
    std::string_view meaning;
};
template <typename Owner>
CountsField(std::string_view, std::array<int, 2> Owner::*, CountLimit, std::string_view)
    -> CountsField<Owner>;

/// One of the names, in the order of the enumeration.
template <typename Owner, typename Enumeration>
struct ChoiceField {
    std::string_view key;
    Enumeration Owner::*member;
    std::span<const std::string_view> names;
    std::string_view meaning;
    Presence presence = Presence::optional;
};
template <typename Owner, typename Enumeration>
ChoiceField(std::string_view, Enumeration Owner::*, std::span<const std::string_view>, std::string_view)
    -> ChoiceField<Owner, Enumeration>;

/// A formula of other sensors, as a text.
template <typename Owner>
struct FormulaField {
    std::string_view key;
    Expression Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
FormulaField(std::string_view, Expression Owner::*, std::string_view) -> FormulaField<Owner>;

struct PolygonInSpace;
struct Surfaces;
struct Band;

/// A plane polygon by "corners" (in the plane z = "height" where they are pairs) and "holes", or by "corner",
/// "edge_u" and "edge_v"; nothing where "object" or "room" is given.
template <typename Owner>
struct PolygonField {
    PolygonInSpace Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
PolygonField(PolygonInSpace Owner::*, std::string_view) -> PolygonField<Owner>;

/// The faces of an "object", of several, or of the "room" around a point, of which "part" picks some.
template <typename Owner>
struct SurfacesField {
    Surfaces Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
SurfacesField(Surfaces Owner::*, std::string_view) -> SurfacesField<Owner>;

/// A width, or a table of "width" and "require".
template <typename Owner>
struct BandField {
    std::string_view key;
    std::optional<Band> Owner::*member;
    std::string_view meaning;
};
template <typename Owner>
BandField(std::string_view, std::optional<Band> Owner::*, std::string_view) -> BandField<Owner>;

/// A contradiction between the keys of a sensor: the key to change, and the message for it.
struct Fault {
    std::string_view key;
    std::string message;
};

/// The keys that a scene file gives.
class GivenKeys {
  public:
    explicit GivenKeys(std::vector<std::string> keys) : keys_(std::move(keys)) {}
    bool has(std::string_view key) const {
        for (const std::string& given : keys_) {
            if (given == key) return true;
        }
        return false;
    }

  private:
    std::vector<std::string> keys_;
};

/// The name of a sensor's readings: "3 lines of sight".
struct Noun {
    std::string_view one, many;
};
inline constexpr Noun kPoints{"point", "points"};

}  // namespace stilb::sensors
