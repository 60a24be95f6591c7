// Method auto: for few readings path tracing (path/path.cpp) or local estimation that is balanced with it
// (local/local_estimation.cpp), for many the latter or the same by a guess of the light. Light paths pay
// where many readings share them, and where path tracing finds light rarely; a guess pays where still more
// readings share it, and where it lacks little of the light.
//
// The candidates are tried in the order of the work of their set-ups. Pilots give their variances, and chosen
// is the one that takes the least work to the wanted error (choose()). One whose set-up alone takes more than
// all of the best so far is not tried, and one that finds clearly less light than path tracing is not taken.
// All are unbiased, and the choice depends on samples with random keys of their own: the result is unbiased,
// too.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "estimators/limits.h"
#include "estimators/local/guess/light_guess.h"
#include "estimators/local/split_plan.h"
#include "materials/split_material.h"
#include "math/morton.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"

namespace stilb::estimators {
namespace {

/// With more readings light paths always pay, and with fewer no guess (docs/lab-book.md).
constexpr std::size_t kMostReadings = 64;
/// Pilots of more readings measure as many as these, in runs of neighbours, which share packets of rays.
constexpr std::size_t kMostInPilots = 128, kRun = 16;
/// The smallest run by light paths takes about so much work after planning (as Estimator's costs).
constexpr double kLeastOfLightPaths = 200'000;
/// A run with few readings has so many replicates.
constexpr double kReplicates = 32;
/// Independent parts of a pilot, for its variances.
constexpr std::size_t kPilots = 16;
/// Costs as Estimator's: of a planning ray with its path, and of a patch of a guess.
constexpr double kPlanningRayCost = 30, kPatchCost = 250;
/// So few readings are planned only where path tracing takes more than kWorthPlanning times the work of
/// planning: they may gain nothing by light paths.
constexpr std::size_t kVeryFew = 16;
constexpr double kWorthPlanning = 2;
/// A pilot's part by path tracing: so much work, but at least so many samples.
constexpr double kPathPilotCost = 1000, kLeastPaths = 4;
/// A shorter pilot before that suffices where it promises less than this share of the work that would be
/// worth planning. Over smooth metal it promises 7 times the work of planning, in a diffuse room 0.2 to 1.2.
constexpr double kQuickPilotCost = 125, kLeastQuickPaths = 2, kClearly = 2. / 3;
/// With many Sobol' points light paths have less noise than their pilots promise: a grid behind a door took
/// half the time to 20 % that the guess did, where they promised 0.86 of it (docs/lab-book.md).
constexpr double kSobolGain = 1.25;
/// Samples of a pilot's part by path tracing with which other methods are compared.
constexpr std::uint64_t kComparedPaths = 8;
/// Samples of a pilot's part by the guess.
constexpr std::uint64_t kGuidedSamples = 4;

// Pilots of pictures: some blocks of pixels, in some passes of two replicates. Single passes would say
// little: the more even the samples of a method are, the more its error falls over several passes.
constexpr int kPilotBlock = 8, kPilotRows = 4;
constexpr std::uint64_t kPilotPasses = 4, kPilotReplicates = 2;
/// The processor time of a pass by the guess over that of one without, where all is diffuse, and with gloss,
/// whose light comes by light paths in both (docs/lab-book.md).
constexpr double kGuidedPassCost = 1.3, kGlossyPassCost = 1.5;
/// This is added for each gathering ray of a pixel that path tracing continues. Few are in rooms, and nearly
/// all of them beside a ground of kilometres.
constexpr double kContinuedCost = 2.5;

/// The readings of the parts of a pilot.
struct Pilot {
    std::vector<double> means, deviations;   ///< of each reading: mean and standard deviation of the parts
    double cost = 0;                         ///< of a part
    double least_cost = 0;                   ///< of the smallest run
    std::vector<std::vector<double>> parts;  ///< the readings of each
};

Pilot run_pilot(const Estimator& method, std::uint64_t samples, math::RandomKey key) {
    const std::size_t readings = method.known_part().size();
    std::vector<std::vector<double>> parts(kPilots);
    parallel_for(kPilots, [&](std::size_t part) {
        Tally sums(readings);
        method.run_batch({{key.derived(part)}, 0, samples}, sums);
        for (std::size_t j = 0; j < readings; ++j) {
            const Rgb mean = method.known_part()[j] + sums.sum[j] * (1 / static_cast<double>(samples));
            parts[part].push_back(mean.luminance());
        }
    });
    Pilot pilot{{}, {}, static_cast<double>(samples) * method.cost_per_sample(), 0, {}};
    for (std::size_t j = 0; j < readings; ++j) {
        double mean = 0, squares = 0;
        for (const auto& part : parts) mean += part[j] / kPilots;
        for (const auto& part : parts) squares += (part[j] - mean) * (part[j] - mean);
        pilot.means.push_back(mean);
        pilot.deviations.push_back(std::sqrt(squares / (kPilots - 1)));
    }
    pilot.parts = std::move(parts);
    return pilot;
}

/// The dark levels of the sensors (statistics::dark_level), by readings, which have about these values.
std::vector<double> dark_levels(std::span<const double> values, const Problem& problem) {
    const auto sensor_of = [&](std::size_t j) { return problem.sensors.empty() ? 0 : problem.sensors[j]; };
    std::vector<std::vector<double>> of_sensors;
    for (std::size_t j = 0; j < values.size(); ++j) {
        of_sensors.resize(std::max<std::size_t>(of_sensors.size(), sensor_of(j) + 1));
        of_sensors[sensor_of(j)].push_back(values[j]);
    }
    std::vector<double> levels, of_readings;
    for (const std::vector<double>& of_sensor : of_sensors)
        levels.push_back(statistics::dark_level(of_sensor));
    for (std::size_t j = 0; j < values.size(); ++j) of_readings.push_back(levels[sensor_of(j)]);
    return of_readings;
}

/// The work to the problem's error on average over the readings, which have about these values. Not to a mean
/// of squares: few readings in corners would outweigh all others.
double sampling_cost(const Pilot& pilot, std::span<const double> values, const Problem& problem) {
    const std::span<const double> weights = problem.weights;
    const std::vector<double> dark = dark_levels(values, problem);
    double sum = 0, all = 0;
    for (std::size_t j = 0; j < values.size(); ++j) {
        const double weight = weights.empty() ? 1 : weights[j], value = std::max(values[j], dark[j]);
        all += weight;
        if (value > 0) sum += weight * pilot.deviations[j] / value;
    }
    const double error_of_part = sum / all;
    const double wanted = problem.error / 2;  // half of an interval is about two standard errors
    return std::max(pilot.least_cost, pilot.cost * error_of_part * error_of_part / (wanted * wanted));
}

/// The larger means: what a method finds rarely, its pilot may have missed.
std::vector<double> larger(std::span<const double> a, std::span<const double> b) {
    std::vector<double> means;
    std::ranges::transform(a, b, std::back_inserter(means),
                           [](double x, double y) { return std::max(x, y); });
    return means;
}

/// Where path tracing has found nothing, its variance says nothing. Readings have about these values: those
/// of dark ones do not matter.
bool finds_light(const Pilot& pilot, std::span<const double> values, const Problem& problem) {
    const std::vector<double> dark = dark_levels(values, problem);
    for (std::size_t j = 0; j < values.size(); ++j) {
        if (!(pilot.means[j] > 0) && !(values[j] < dark[j])) return false;
    }
    return true;
}

/// Whether a method has found clearly less light than path tracing: it finds some so rarely that its pilot
/// has missed it, such as light paths of the sky which start around a scene that is much larger than the room
/// with the readings. Then its variance says nothing.
bool misses_light(const Pilot& pilot, const Pilot& of_path, const Problem& problem) {
    constexpr double standard_errors = 4, rounding = 1e-4;
    const std::vector<double> values = larger(pilot.means, of_path.means),
                              dark = dark_levels(values, problem);
    const auto relative_sum = [&](const Pilot& of_method) {
        std::vector<double> sums(of_method.parts.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            for (std::size_t j = 0; j < values.size(); ++j) {
                const double value = std::max(values[j], dark[j]);
                if (value > 0) sums[i] += of_method.parts[i][j] / value;
            }
        }
        return statistics::estimate_from_replicates(sums);
    };
    const statistics::Estimate all = relative_sum(of_path), found = relative_sum(pilot);
    return all.value - found.value > rounding * all.value &&
           statistics::z_score(all, found) > standard_errors;
}

/// Readings of a problem, spread evenly over all of them, which pilots measure.
struct Survey {
    explicit Survey(const Problem& whole) {
        const std::size_t all = whole.measurands.size(), runs = std::min(all, kMostInPilots) / kRun;
        const std::vector<std::uint32_t> order = neighbours(whole.measurands);
        for (std::size_t run = 0; run < runs; ++run) {
            const std::size_t first = (2 * run + 1) * (all - kRun) / (2 * runs);
            for (const std::uint32_t i : std::span(order).subspan(first, kRun)) {
                measurands.push_back(whole.measurands[i]);
                if (!whole.weights.empty()) weights.push_back(whole.weights[i]);
                if (!whole.sensors.empty()) sensors.push_back(whole.sensors[i]);
            }
        }
        stands_for = static_cast<double>(all) / static_cast<double>(measurands.size());
    }
    /// The problem of these readings.
    Problem part_of(Problem whole) const {
        whole.measurands = measurands;
        whole.weights = weights;
        whole.sensors = sensors;
        whole.stands_for = stands_for;
        return whole;
    }

    std::vector<Measurand> measurands;
    std::vector<double> weights;
    std::vector<std::uint32_t> sensors;
    double stands_for = 1;

  private:
    /// Measurands in an order in which neighbours in space follow each other, as in the packets of a run.
    static std::vector<std::uint32_t> neighbours(std::span<const Measurand> measurands) {
        std::vector<Vec3> positions;
        for (const Measurand& measurand : measurands) positions.push_back(sensors::position_of(measurand));
        return math::morton_order(positions);
    }
};

/// Blocks that are spread over a picture.
std::vector<PixelBlock> pilot_blocks(const std::array<int, 2>& resolution) {
    const auto& [width, height] = resolution;
    std::vector<PixelBlock> blocks;
    for (int row = 0; row < kPilotRows; ++row) {
        for (int column = 0; column < kPilotRows; ++column) {
            const int left = (2 * column + 1) * width / (2 * kPilotRows);
            const int top = (2 * row + 1) * height / (2 * kPilotRows);
            blocks.push_back(
                {left, top, std::min(kPilotBlock, width - left), std::min(kPilotBlock, height - top)});
        }
    }
    return blocks;
}

/// The luminances of the blocks' pixels in each replicate; the cost is that of a pass, in passes without a
/// guess. `cost`: without that of continued rays.
Pilot run_picture_pilot(const Estimator& method, const std::array<int, 2>& resolution, double cost,
                        math::RandomKey key) {
    const std::vector<PixelBlock> blocks = pilot_blocks(resolution);
    std::vector<std::unique_ptr<const PicturePass>> passes(kPilotReplicates * kPilotPasses);
    parallel_for(passes.size(), [&](std::size_t i) {
        passes[i] = method.start({{key.derived(i / kPilotPasses)}, i % kPilotPasses});
    });
    std::vector<std::array<std::vector<double>, kPilotReplicates>> luminances(blocks.size());
    std::atomic<std::uint64_t> continued = 0;
    parallel_for(blocks.size(), [&](std::size_t b) {
        for (std::size_t i = 0; i < passes.size(); ++i) {
            Tally samples(blocks[b].pixels());
            passes[i]->sample(blocks[b], samples);
            continued += samples.continued;
            std::vector<double>& sums = luminances[b][i / kPilotPasses];
            sums.resize(samples.sum.size());
            for (std::size_t j = 0; j < sums.size(); ++j)
                sums[j] += samples.sum[j].luminance() / kPilotPasses;
        }
    });
    Pilot pilot{{}, {}, cost, 0, {}};
    for (const auto& [first, second] : luminances) {
        for (std::size_t j = 0; j < first.size(); ++j) {
            pilot.means.push_back((first[j] + second[j]) / 2);
            pilot.deviations.push_back(std::abs(first[j] - second[j]) / std::numbers::sqrt2);
        }
    }
    const auto samples = static_cast<double>(passes.size() * pilot.means.size());
    pilot.cost += kContinuedCost * static_cast<double>(continued) / samples;
    return pilot;
}

/// The work to a mean squared error of all pixels, times that error: single bright dots disturb a picture.
double picture_cost(const Pilot& pilot, std::span<const double> values, const Problem&) {
    const double dark = statistics::dark_level(values);
    double squares = 0;
    for (std::size_t j = 0; j < values.size(); ++j) {
        const double value = std::max(values[j], dark);
        const double error = value > 0 ? pilot.deviations[j] / value : 0;
        squares += error * error;
    }
    return pilot.cost * squares / static_cast<double>(values.size());
}

bool has_gloss(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const auto& named) {
        return materials::split(named.material).gloss.has_value();
    });
}

/// A technique, with the work of trying it (as Estimator's costs).
struct Candidate {
    struct Trial {
        std::function<Pilot(const Estimator&)> pilot;
        /// The next technique is not tried where this share of its set-up takes more than all of the best
        /// one.
        double enough = 1;
    };

    EstimatorMaker make;
    std::vector<Trial> trials;
    double set_up_cost = 0;  ///< before the trials
    double least_cost = 0;   ///< of the smallest run
    double cost_left = 0;    ///< after the trials, before samples count
    double factor = 1;       ///< of the sampling that a pilot promises
    /// Path tracing, the first: others that find clearly less light miss some. Its own variance says nothing
    /// where its pilot has found no light.
    bool is_path = false;
};
/// The work that is left by what is chosen only where all others miss light, and by what misses some.
constexpr double kLastResort = 1e300, kNever = std::numeric_limits<double>::infinity();

struct Question {
    const Problem& problem;
    const Problem& part;  ///< of it, for the trials; or all of it
    double (*cost)(const Pilot&, std::span<const double> values, const Problem& part);
};

struct Tried {
    const Candidate* candidate;
    std::unique_ptr<Estimator> estimator;  ///< of the part
    Pilot pilot;
};

/// The work by each; kNever where it misses light.
std::vector<double> costs_of(std::span<const Tried> tried, const Question& question) {
    std::vector<double> values(tried[0].pilot.means.size());
    for (const Tried& one : tried) {
        if (one.candidate->cost_left < kLastResort) values = larger(values, one.pilot.means);
    }
    std::vector<double> costs;
    for (const Tried& one : tried) {
        const Candidate& candidate = *one.candidate;
        const bool misses = candidate.is_path ? !finds_light(one.pilot, values, question.part)
                                              : tried[0].candidate->is_path &&
                                                    misses_light(one.pilot, tried[0].pilot, question.part);
        const double sampling = candidate.factor * question.cost(one.pilot, values, question.part);
        costs.push_back(misses ? kNever : candidate.cost_left + sampling);
    }
    return costs;
}

/// The candidate, in the order of the work of their set-ups, that takes the least work in all.
std::unique_ptr<Estimator> choose(std::span<const Candidate> candidates, const Question& question) {
    if (candidates.size() == 1) return candidates[0].make(question.problem);
    std::vector<Tried> tried;
    const auto is_enough = [&](const Candidate& candidate, double share) {
        if (&candidate == &candidates.back()) return false;
        const Candidate& next = *(&candidate + 1);
        return std::ranges::min(costs_of(tried, question)) < share * next.set_up_cost + next.least_cost;
    };
    std::ranges::any_of(candidates, [&](const Candidate& candidate) {
        tried.push_back({&candidate, candidate.make(question.part), {}});
        return std::ranges::any_of(candidate.trials, [&](const Candidate::Trial& trial) {
            tried.back().pilot = trial.pilot(*tried.back().estimator);
            return is_enough(candidate, trial.enough);
        });
    });
    const std::vector<double> costs = costs_of(tried, question);
    // Where all miss light, the last one.
    std::size_t best = 0;
    for (std::size_t i = 1; i < costs.size(); ++i) {
        if (costs[i] <= costs[best]) best = i;
    }
    if (&question.part == &question.problem) return std::move(tried[best].estimator);
    return tried[best].candidate->make(question.problem);
}

Candidate::Trial trial_of_few(math::RandomKey key, const auto& samples_of, double enough = 1) {
    return {[=](const Estimator& method) {
                Pilot pilot = run_pilot(method, samples_of(method), key);
                pilot.least_cost =
                    kReplicates * static_cast<double>(method.first_check()) * method.cost_per_sample();
                return pilot;
            },
            enough};
}

std::unique_ptr<Estimator> choose_for_few(const Problem& problem) {
    const math::KeyOf key = problem.preparation_key;
    const auto paths = [](double cost, double least) {
        return [=](const Estimator& path) {
            return static_cast<std::uint64_t>(std::max(least, cost / path.cost_per_sample()));
        };
    };
    const double planning = kPlanningRayCost * planning_rays(problem.measurands.size());
    std::vector<Candidate> candidates;
    if (!has_light_for_light_paths_only(problem.scene)) {
        candidates.push_back({.make = make_path,
                              .trials = {trial_of_few(key.derived(PreparationStream::path_pilot),
                                                      paths(kQuickPilotCost, kLeastQuickPaths), kClearly),
                                         trial_of_few(key.derived(PreparationStream::path_pilot),
                                                      paths(kPathPilotCost, kLeastPaths))},
                              .is_path = true});
    }
    candidates.push_back(
        {.make = make_balanced,
         .trials = {trial_of_few(key.derived(PreparationStream::light_paths_pilot),
                                 [](const Estimator& method) { return method.batch_granularity(); })},
         .set_up_cost = planning * (problem.measurands.size() <= kVeryFew ? kWorthPlanning : 1),
         .least_cost = kLeastOfLightPaths});
    return choose(candidates, {problem, problem, sampling_cost});
}

/// Makes the guess once, of the first problem.
EstimatorMaker guided_maker() {
    return [made = std::make_shared<EstimatorMaker>()](const Problem& problem) {
        if (!*made) *made = with_guess(problem);
        return (*made)(problem);
    };
}

std::unique_ptr<Estimator> choose_for_many(const Problem& problem) {
    const Survey survey(problem);
    const Problem part = survey.part_of(problem);
    const math::KeyOf key = problem.preparation_key;
    const auto trial = [](math::RandomKey own_key, std::uint64_t samples) {
        return Candidate::Trial{[=](const Estimator& method) { return run_pilot(method, samples, own_key); }};
    };
    const bool finds_all_by_rays = !has_light_for_light_paths_only(problem.scene);
    std::vector<Candidate> candidates{
        {.make = make_path,
         .trials = {trial(key.derived(PreparationStream::path_pilot), kComparedPaths)},
         .cost_left = finds_all_by_rays ? kLastResort : kNever,
         .is_path = true},
        {.make = make_balanced,
         .trials = {{[=](const Estimator& method) {
             return run_pilot(method, method.batch_granularity(),
                              key.derived(PreparationStream::light_paths_pilot));
         }}},
         .cost_left = kPlanningRayCost * planning_rays(problem.measurands.size())}};
    if (problem.max_reflections == transport::kUnlimited) {
        candidates.push_back({.make = guided_maker(),
                              .trials = {trial(key.derived(PreparationStream::guided_pilot), kGuidedSamples)},
                              .set_up_cost = kPatchCost * LightGuess::patch_count(problem.scene),
                              .factor = kSobolGain});
    }
    return choose(candidates, {problem, part, sampling_cost});
}

std::unique_ptr<Estimator> choose_for_picture(const Problem& problem) {
    const math::KeyOf key = problem.preparation_key;
    const auto trial = [&](math::RandomKey own_key, double cost_of_pass) {
        return Candidate::Trial{[=, resolution = problem.camera->resolution](const Estimator& method) {
            return run_picture_pilot(method, resolution, cost_of_pass, own_key);
        }};
    };
    std::vector<Candidate> candidates{
        {.make = make_balanced, .trials = {trial(key.derived(PreparationStream::light_paths_pilot), 1)}}};
    if (problem.max_reflections == transport::kUnlimited) {
        const double cost = has_gloss(problem.scene) ? kGlossyPassCost : kGuidedPassCost;
        candidates.push_back(
            {.make = make_guided, .trials = {trial(key.derived(PreparationStream::guided_pilot), cost)}});
    }
    return choose(candidates, {problem, problem, picture_cost});
}

}  // namespace

std::unique_ptr<Estimator> make_auto(const Problem& problem) {
    if (problem.camera) return choose_for_picture(problem);
    if (problem.measurands.empty()) return make_balanced(problem);
    return problem.measurands.size() <= kMostReadings ? choose_for_few(problem) : choose_for_many(problem);
}

}  // namespace stilb::estimators
