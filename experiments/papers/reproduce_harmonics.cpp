// Figure 5 of [LocalEstimation] with its head, a series of spherical harmonics that was fitted to a mesh of
// 32 654 faces; and what the paper says of it: 40 % more time, less than a thousandth of the storage.
//
// The paper's mesh is not published: head_shape.h makes another. A mesh reflects by the normals of its
// facets, a series by its own.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "base/version.h"
#include "cli/progress.h"
#include "io/image/picture.h"
#include "io/image/picture_file.h"
#include "io/mesh/mesh_file.h"
#include "io/text/table.h"
#include "papers/head_in_room.h"
#include "papers/head_report.h"
#include "papers/head_shape.h"
#include "papers/picture_sheet.h"
#include "papers/reproduce.h"

namespace stilb::papers {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kColumns = 3;  // of the sheet

/// The mean of the rounds.
io::Picture picture_of(const RenderedHead& head, const std::string& name) {
    const RenderResult& first = head.rounds.front();
    io::PictureOrigin origin;
    origin.scene = "scenes/paper/room.toml with " + name;
    origin.sensor = head.view.name;
    origin.method = first.method;
    origin.command = "stilb reproduce harmonics";
    origin.version = program_version();
    io::Picture mean = io::picture_of(first, *head.view.camera(), origin);
    const auto rounds = static_cast<float>(head.rounds.size());
    for (std::size_t i = 0; i < mean.pixel_count(); ++i) {
        std::array<float, 3> sum{};
        float variance = 0;
        for (const RenderResult& round : head.rounds) {
            for (std::size_t b = 0; b < sum.size(); ++b) sum[b] += round.pixels.rgb_cd_m2[i][b];
            variance += std::pow(round.pixels.standard_error_cd_m2[i], 2.F);
        }
        for (std::size_t b = 0; b < sum.size(); ++b) mean.rgb_cd_m2[i][b] = sum[b] / rounds;
        mean.standard_error_cd_m2[i] = std::sqrt(variance) / rounds;
    }
    mean.origin.paths = first.samples * head.rounds.size();
    mean.origin.replicates = first.replicates * static_cast<int>(head.rounds.size());
    return mean;
}

void write_both(const io::Picture& picture, const fs::path& directory, const std::string& name,
                const io::ToneOptions& tone) {
    for (const char* extension : {"exr", "png"}) {
        write_picture(picture, directory / fmt::format("harmonics-{}.{}", name, extension), tone);
    }
}

/// All by one exposure: the mesh's.
void write_pictures(const HeadStudy& study, const fs::path& directory) {
    std::vector<LabelledPicture> pictures{
        {fmt::format("mesh, {} faces", study.report.faces), picture_of(study.mesh, "the mesh")}};
    std::vector<std::string> names{"mesh"};
    for (const HeadSeries& series : study.series) {
        const std::string name = fmt::format("degree {}", series.degree);
        pictures.push_back({name, picture_of(series.rendered, "a series of " + name)});
        names.push_back(std::to_string(series.degree));
    }
    const double exposure = automatic_exposure(pictures.front().picture);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        write_both(pictures[i].picture, directory, names[i], {exposure});
    }
    draw_picture_sheet(pictures, kColumns, io::ToneCurve(exposure), directory / "harmonics-degrees.png");
}

/// The mesh and its name.
std::pair<Mesh, std::string> read_or_make_head(const fs::path& directory, const std::string& file) {
    if (!file.empty()) return {io::read_mesh_file(file).mesh, file};
    Mesh mesh = head_mesh();
    const fs::path path = directory / "head.obj";
    io::write_file(path, io::to_obj(mesh));
    return {std::move(mesh), path.string()};
}

}  // namespace

void reproduce_harmonics(const fs::path& directory, const std::string& mesh_file) {
    const auto [mesh, name] = read_or_make_head(directory, mesh_file);
    cli::TerminalProgress progress("passes");
    const HeadStudy study = study_head(mesh, name, {}, &progress);
    for (const std::string& warning : warnings_of(study.report)) fmt::print(stderr, "warning: {}\n", warning);
    fmt::print("{}", to_text(study));
    write_csv(columns_of(study), directory / "harmonics.csv");
    for (const char* extension : {"svg", "png"})
        draw_plot(plot_of(study), directory / fmt::format("harmonics.{}", extension));
    write_pictures(study, directory);
    write_both(picture_of(study.room_with_series, fmt::format("a series of degree {}", study.room_degree)),
               directory, "room", {});
}

}  // namespace stilb::papers
