// A head as a mesh and as series of spherical harmonics fitted to it: how far off the series are, how large,
// and how long their pictures take.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/commands/fit_report.h"
#include "run/run.h"
#include "scene/scene.h"

namespace stilb::papers {

struct HeadStudyOptions {
    std::vector<int> degrees{4, 8, 16, 32, 64};  ///< growing
    std::array<int, 2> resolution{160, 192};     ///< of the pictures of the head
    std::array<int, 2> room_resolution{320, 240};
    std::uint64_t passes = 12;  ///< of each picture
    /// A round is a picture of the mesh and one of each series, with the same seed; even.
    int rounds = 4;
};

/// The pictures of a scene, one for each round.
struct RenderedHead {
    Sensor view;
    std::vector<RenderResult> rounds{};
    /// The least of the rounds' processor times, and of the ray caster's set-up, which is part of them.
    double processor_s = 0, set_up_s = 0;
};

struct HeadSeries {
    int degree = 0;
    RenderedHead rendered;
    /// Mean absolute difference of the luminances from those of the mesh, as a share of their mean: over the
    /// pixels that show the mesh. Noise is what of it chance alone would make.
    double luminance_difference = 0, noise = 0;
    /// Root mean square in these pixels: between the series' normals and the mesh's smooth ones.
    double normal_error_rad = 0;
};

struct HeadStudy {
    cli::FitReport report;  ///< of the highest degree; the lower ones are the same series, cut off
    RenderedHead mesh;
    std::vector<HeadSeries> series;
    double head_share = 0;  ///< of the pixels
    /// The whole room with the mesh, and with the series of the paper's degree (or the highest below).
    RenderedHead room_with_mesh, room_with_series;
    int room_degree = 0;

    double time_ratio(const HeadSeries& one) const { return one.rendered.processor_s / mesh.processor_s; }
    double room_time_ratio() const { return room_with_series.processor_s / room_with_mesh.processor_s; }
};

/// In the room of head_in_room.h. A mesh that is not star-shaped is taken by its outermost surface. Throws
/// InputError with `name` where a series is no surface.
HeadStudy study_head(const Mesh& head, const std::string& name, const HeadStudyOptions& options,
                     PictureSink* progress = nullptr);

}  // namespace stilb::papers
