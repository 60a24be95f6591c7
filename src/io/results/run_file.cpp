#include "io/results/run_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/version.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "materials/model_list.h"
#include "run/pictures/picture_sums.h"
#include "run/readings/division.h"
#include "run/solve.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr std::uint32_t kRunVersion = 2;
constexpr std::string_view kBeginAgain = "Copy the file again, or begin the run again.";
/// A state file has a chunk for its origin and one for each result; more are damaged bytes.
constexpr std::uint32_t kMostChunks = 1 << 16;

// Traits.

/// A hash of numbers and texts, one after another.
class Fingerprint {
  public:
    template <typename Value>
    void add(const Value& value) {
        if constexpr (std::is_convertible_v<Value, std::string_view>) {
            hash_ =
                hash_of(fmt::format("{}:{}", std::string_view(value).size(), std::string_view(value)), hash_);
        } else if constexpr (std::is_enum_v<Value>) {
            add(static_cast<int>(value));
        } else {
            static_assert(std::is_trivially_copyable_v<Value>);
            hash_ = hash_of({reinterpret_cast<const char*>(&value), sizeof value}, hash_);
        }
    }
    void add(const materials::SharesByAngle& shares) {
        for (const materials::SharesByAngle::Row& row : shares.rows) add(row);
    }
    std::string text() const { return fmt::format("{:016x}", hash_); }

  private:
    std::uint64_t hash_ = kEmptyHash;
};

/// Of cameras: all that is in their pictures.
void add_camera(const Camera& camera, Fingerprint& print) {
    for_each_field<Camera>([&](const auto& field) { print.add(camera.*field.member); });
}

/// Of other sensors: places and directions of their readings.
void add_readings(const Sensor& sensor, Fingerprint& print) {
    print.add(sensor.size());
    for (std::size_t j = 0; j < sensor.size(); ++j) {
        const sensors::Location location = sensor.location(j);
        print.add(location.position);
        for (const sensors::Location::Direction& direction : location.directions) print.add(direction.value);
    }
}

std::string fingerprint_of(std::span<const Sensor> sensors) {
    Fingerprint print;
    for (const Sensor& sensor : sensors) {
        if (sensor.derived()) continue;
        print.add(sensor.name);
        print.add(sensor.type());
        if (const Camera* camera = sensor.camera())
            add_camera(*camera, print);
        else
            add_readings(sensor, print);
    }
    return print.text();
}

std::string fingerprint_of(const estimators::PatchMethodOptions& options) {
    Fingerprint print;
    const auto& [variant, shooting, bin_rings] = options.first_shot;
    for (const int number :
         {variant ? static_cast<int>(*variant) : -1, static_cast<int>(shooting.window),
          static_cast<int>(shooting.backend), shooting.resolution, bin_rings, options.resolution.value_or(-1),
          static_cast<int>(options.directions), options.shot_resolution})
        print.add(number);
    return print.text();
}

/// Of a scene without files: what tells it apart from others that are at hand, by numbers of all its parts.
std::string fingerprint_of(const Scene& scene) {
    Fingerprint print;
    for (const Object& object : scene.objects) {
        print.add(object.name);
        print.add(bounds_of(object.shape));
        print.add(area_m2(object.shape));
        for (const MaterialId material : object.materials) print.add(material);
    }
    for (const NamedMaterial& material : scene.materials) {
        print.add(material.name);
        if (material.back) print.add(*material.back);
        materials::visit_model(
            [&]<typename Model>(const Model& model) {
                print.add(Model::kType);
                for_each_field<materials::ParametersOf<Model>>(
                    [&](const auto& field) { print.add(materials::parameters_of(model).*field.member); });
            },
            material.material);
    }
    for (const Light& light : scene.lights) {
        print.add(light.name);
        print.add(type_of(light));
        print.add(scene::flux_lm(scene, light));
        if (const auto origin = lights::point_origin(light)) {
            print.add(origin->position);
            print.add(origin->axis.value_or(Vec3{}));
            print.add(origin->intensity_cd.value_or(Rgb{}));
        }
    }
    return print.text();
}

/// Of what is kept apart: factors alone may change.
std::string fingerprint_of(const run::LightDivision& division) {
    Fingerprint print;
    for (const std::uint32_t group : division.channels()->groups.of_light) print.add(group);
    print.add(division.channels()->orders);
    return print.text();
}

/// Whether an option says when a run ends, or how fast it is, and nothing of its samples.
bool is_limit(std::string_view key) {
    constexpr std::array<std::string_view, 4> limits{"error", "time", "paths", "threads"};
    return std::ranges::find(limits, key) != limits.end();
}

/// Nothing of a run that goes on.
std::optional<StopReason> stop_reason_of(const RunOrigin& origin) {
    const auto found = std::ranges::find(run::kStopReasonNames, origin.ending);
    if (found == run::kStopReasonNames.end()) return std::nullopt;
    return static_cast<StopReason>(found - run::kStopReasonNames.begin());
}

// Texts.

std::string difference(const RunTrait* stored, const RunTrait* asked) {
    const std::string& name = (stored ? stored : asked)->name;
    if (name == "scene")
        return "materials, objects or lights of its scene, or files that the scene refers to, have changed "
               "since";
    if (name == "sensors") return "its sensors are others";
    if (name == "version")
        return fmt::format("it was made by Stilb {}, and this is Stilb {}, whose samples may differ",
                           stored->value, asked->value);
    if (name == "light scenes") return "the light scenes tell other lights apart";
    if (name == "patches") return "its options of patches and first shot are others";
    return fmt::format("its {} is {}, here it is {}", name, stored ? stored->value : "not given",
                       asked ? asked->value : "not given");
}

const RunTrait* find(const RunTraits& traits, std::string_view name) {
    const auto found = std::ranges::find(traits, name, &RunTrait::name);
    return found == traits.end() ? nullptr : &*found;
}

// Bytes.

std::string bytes_of(const RunOrigin& origin) {
    ByteWriter bytes;
    bytes.add_list(origin.version);
    bytes.add_list(origin.command);
    bytes.add(std::uint64_t{origin.arguments.size()});
    for (const std::string& argument : origin.arguments) bytes.add_list(argument);
    bytes.add_list(origin.folder);
    bytes.add(std::uint64_t{origin.traits.size()});
    for (const RunTrait& trait : origin.traits) {
        bytes.add_list(trait.name);
        bytes.add_list(trait.value);
    }
    bytes.add(origin.elapsed_s);
    bytes.add_list(origin.ending);
    return bytes.take();
}

RunOrigin read_origin(std::string_view contents, const std::string& name) {
    ByteReader bytes(contents, 0, name, kBeginAgain);
    const auto text = [&](std::string_view what) { return bytes.take_list<std::string>(what); };
    RunOrigin origin;
    origin.version = text("Stilb's version");
    origin.command = text("the command");
    const auto arguments = bytes.take<std::uint64_t>("the number of arguments");
    for (std::uint64_t i = 0; i < arguments; ++i) origin.arguments.push_back(text("an argument"));
    origin.folder = text("the folder");
    const auto traits = bytes.take<std::uint64_t>("the number of traits");
    for (std::uint64_t i = 0; i < traits; ++i) {
        std::string trait = text("a trait");
        origin.traits.push_back({std::move(trait), text("the value of a trait")});
    }
    origin.elapsed_s = bytes.take<double>("the time");
    origin.ending = text("the ending");
    bytes.expect_end();
    return origin;
}

std::string chunk_head(std::string_view contents) {
    ByteWriter bytes;
    bytes.add(std::uint64_t{contents.size()});
    bytes.add(hash_of(contents));
    return bytes.take();
}

std::vector<std::string> parts_of(const StoredRun& stored) {
    ByteWriter head;
    head.add(kRunVersion);
    head.add(static_cast<std::uint32_t>(1 + stored.sums.size()));
    std::vector<std::string> parts{std::string(kRunBeginning) + head.take()};
    const auto add = [&](std::string contents) {
        parts.push_back(chunk_head(contents));
        parts.push_back(std::move(contents));
    };
    add(bytes_of(stored.origin));
    for (const StoredSums& sums : stored.sums) {
        ByteWriter name;
        name.add_list(sums.name);
        add(name.take() + sums.bytes);
    }
    return parts;
}

/// The chunks of a file, whose hashes are right. Each view is into `bytes`.
std::vector<std::string_view> chunks_of(std::string_view bytes, const std::string& name, std::uint32_t most) {
    const auto fail = [&](const std::string& message) { throw InputError(message, {name}); };
    if (!bytes.starts_with(kRunBeginning))
        fail(fmt::format("not the state of a run: the file does not begin with {}.", kRunBeginning));
    const auto numbers_at = [&](std::size_t place) {
        return ByteReader(bytes.substr(place), place, name, kBeginAgain);
    };
    std::size_t place = kRunBeginning.size();
    ByteReader head = numbers_at(place);
    const auto version = head.take<std::uint32_t>("the version");
    if (version != kRunVersion)
        fail(
            fmt::format("the state is of version {}, but Stilb {} reads version {}. Continue it with the "
                        "Stilb that began it.",
                        version, program_version(), kRunVersion));
    const auto count = head.take<std::uint32_t>("the number of chunks");
    if (count == 0 || count > kMostChunks) head.fail(fmt::format("{} chunks", count));
    place += 2 * sizeof(std::uint32_t);
    std::vector<std::string_view> chunks;
    for (std::uint32_t i = 0; i < std::min(count, most); ++i) {
        ByteReader chunk = numbers_at(place);
        const auto size = chunk.take<std::uint64_t>("the size of a chunk");
        const auto hash = chunk.take<std::uint64_t>("the hash of a chunk");
        place += 2 * sizeof(std::uint64_t);
        if (size > bytes.size() - place)
            fail(fmt::format("the file was cut off: it lacks {} bytes. {}", size - (bytes.size() - place),
                             kBeginAgain));
        chunks.push_back(bytes.substr(place, size));
        if (hash_of(chunks.back()) != hash)
            fail(
                fmt::format("damaged: the bytes from {} on do not match their hash. {}", place, kBeginAgain));
        place += size;
    }
    if (chunks.size() == count && place != bytes.size())
        fail(fmt::format("{} surplus bytes at the end. {}", bytes.size() - place, kBeginAgain));
    return chunks;
}

}  // namespace

RunTraits traits_of(const SceneFile& scene, std::span<const Sensor> sensors, const RunOptions& options) {
    RunTraits traits{{"version", program_version()},
                     {"scene", scene.sources.empty() ? fingerprint_of(scene.scene)
                                                     : light_hash(scene.sources, scene.overrides)},
                     {"sensors", fingerprint_of(sensors)}};
    run::for_each_value(options, [&](const auto& option, const auto& value) {
        if (!is_limit(option.key)) traits.push_back({std::string(option.key), fmt::format("{}", value)});
    });
    if (options.replicates)
        traits.push_back({"number of replicates", fmt::format("{}", *options.replicates)});
    if (!options.light_scenes.empty())
        traits.push_back({"light scenes", fingerprint_of(run::LightDivision(scene.scene, options))});
    traits.push_back({"patches", fingerprint_of(options.patches)});
    return traits;
}

void set_ending(const RunOrigin& origin, run::RunSummary& result) {
    result.elapsed_s = origin.elapsed_s;
    // Merged parts are all that was asked for, and may have met the error.
    const StopReason ended = stop_reason_of(origin).value_or(StopReason::interrupted);
    if (ended != StopReason::paths_done) result.stop_reason = ended;
    if (ended == StopReason::interrupted) result.converged = false;
}

bool is_finished(const RunOrigin& origin) {
    const std::optional<StopReason> reason = stop_reason_of(origin);
    return reason && *reason != StopReason::time_over && *reason != StopReason::interrupted;
}

void add_hashes(const SceneFile& scene, RunResult& result) {
    std::vector<Sensor> sensors;
    for (const SensorResult& sensor : result.sensors) sensors.push_back(sensor.sensor);
    result.sensors_hash = fingerprint_of(sensors);
    if (!scene.sources.empty()) result.scene_hash = content_hash(scene.sources);
}

void require_same_run(const RunOrigin& stored, const RunTraits& traits, const std::string& name) {
    const auto refuse = [&](const RunTrait* own, const RunTrait* asked) {
        throw InputError(fmt::format("this is the state of another run: {}.", difference(own, asked)),
                         {name});
    };
    for (const RunTrait& own : stored.traits) {
        const RunTrait* const asked = find(traits, own.name);
        if (!asked || *asked != own) refuse(&own, asked);
    }
    for (const RunTrait& asked : traits) {
        if (!find(stored.traits, asked.name)) refuse(nullptr, &asked);
    }
}

void require_mergeable(const RunOrigin& stored, const RunTraits& traits, const std::string& name) {
    const auto without_seed = [](RunTraits all) {
        std::erase_if(all, [](const RunTrait& trait) { return trait.name == "seed"; });
        return all;
    };
    RunOrigin own;
    own.traits = without_seed(stored.traits);
    require_same_run(own, without_seed(traits), name);
}

std::filesystem::path folder_of(const RunOrigin& origin, const std::filesystem::path& state_file) {
    return (std::filesystem::absolute(state_file).parent_path() / origin.folder).lexically_normal();
}

std::string relative_folder(const std::filesystem::path& folder, const std::filesystem::path& state_file) {
    return std::filesystem::proximate(folder, std::filesystem::absolute(state_file).parent_path())
        .generic_string();
}

template <typename Sums>
Sums read_sums(const StoredRun& stored, std::string_view name, const std::string& file) {
    const auto found = std::ranges::find(stored.sums, name, &StoredSums::name);
    if (found == stored.sums.end()) throw InputError(fmt::format("the run has no sums of {}", name), {file});
    ByteReader bytes(found->bytes, 0, file, kBeginAgain);
    Sums sums = Sums::read(bytes);
    bytes.expect_end();
    return sums;
}
template run::RunState read_sums(const StoredRun&, std::string_view, const std::string&);
template run::SolutionState read_sums(const StoredRun&, std::string_view, const std::string&);
template run::PictureSums read_sums(const StoredRun&, std::string_view, const std::string&);

std::string sums_of_picture(const Sensor& camera) { return fmt::format("picture {}", camera.name); }

std::string to_bytes(const StoredRun& stored) {
    std::string bytes;
    for (const std::string& part : parts_of(stored)) bytes += part;
    return bytes;
}

StoredRun read_run(std::string_view bytes, const std::string& name) {
    const std::vector<std::string_view> chunks = chunks_of(bytes, name, kMostChunks);
    StoredRun stored{read_origin(chunks.front(), name), {}};
    for (const std::string_view chunk : std::span(chunks).subspan(1)) {
        ByteReader reader(chunk, 0, name, kBeginAgain);
        auto sums_name = reader.take_list<std::string>("the name of sums");
        const std::size_t begun = sizeof(std::uint64_t) + sums_name.size();
        stored.sums.push_back({std::move(sums_name), std::string(chunk.substr(begun))});
    }
    return stored;
}

RunOrigin read_run_origin(std::string_view bytes, const std::string& name) {
    return read_origin(chunks_of(bytes, name, 1).front(), name);
}

StoredRun read_run_file(const std::filesystem::path& path) {
    return read_run(read_whole_file(path), path.string());
}

void write_run_file(const StoredRun& stored, const std::filesystem::path& path) {
    replace_file(path, parts_of(stored));
}

}  // namespace stilb::io
