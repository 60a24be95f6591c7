// Files that random scenes refer to: luminaires, meshes and a panorama.
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "io/image/picture_file.h"
#include "random/generator.h"
#include "random/photometry.h"

namespace stilb::random {
namespace {

using Faces = std::vector<std::vector<int>>;

/// Lets `write` make a file of another name first: another run may read the old one now.
template <typename Write>
void replace(const std::filesystem::path& path, const Write& write) {
    std::filesystem::path unfinished = path;
    unfinished.replace_filename(fmt::format("{}-{}", getpid(), path.filename().string()));
    write(unfinished);
    std::filesystem::rename(unfinished, path);
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    replace(path, [&](const std::filesystem::path& unfinished) { std::ofstream(unfinished) << text; });
}

void write_photometry(const std::filesystem::path& path, std::string_view name, std::string_view opening,
                      int planes, double (*intensity_cd)(double gamma_deg, double c_deg)) {
    constexpr int kGammas = 91;
    std::string text = fmt::format("IESNA:LM-63-2002\n[TEST] {}\nTILT=NONE\n1 -1 1 {} {} 1 2 {} 0\n1 1 20\n",
                                   name, kGammas, planes, opening);
    const double step = planes > 1 ? 360. / (planes - 1) : 0;
    for (int g = 0; g < kGammas; ++g) text += fmt::format("{} ", g);
    text += "\n";
    for (int c = 0; c < planes; ++c) text += fmt::format("{} ", c * step);
    for (int c = 0; c < planes; ++c) {
        text += "\n";
        for (int g = 0; g < kGammas; ++g) text += fmt::format("{:.6f} ", intensity_cd(g, c * step));
    }
    write_text(path, text + "\n");
}

void write_obj(const std::filesystem::path& path, const std::vector<Vec3>& vertices, const Faces& faces) {
    std::string text;
    for (const Vec3& v : vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    for (const std::vector<int>& face : faces) {
        text += "f";
        for (const int corner : face) text += fmt::format(" {}", corner + 1);
        text += "\n";
    }
    write_text(path, text);
}

void write_ply(const std::filesystem::path& path, const std::vector<Vec3>& vertices, const Faces& faces) {
    std::string text = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double "
        "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        vertices.size(), faces.size());
    for (const Vec3& v : vertices) text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
    for (const std::vector<int>& face : faces)
        text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
    write_text(path, text);
}

/// A closed body in the shape of an L, within half a metre of the origin.
void write_things(const std::filesystem::path& folder) {
    std::vector<Vec3> vertices;
    for (const double z : {-0.5, 0.5}) {
        for (const auto& [x, y] :
             {std::array{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.}, {0., 0.}, {0., 0.5}, {-0.5, 0.5}})
            vertices.push_back({x, y, z});
    }
    Faces faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (int i = 0; i < 6; ++i) faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
    write_obj(folder / kThingFiles[0], vertices, faces);
    write_ply(folder / kThingFiles[1], vertices, faces);
}

/// A box without a bottom, a metre wide: the body of a luminaire that shines downwards.
void write_body(const std::filesystem::path& path) {
    std::vector<Vec3> vertices;
    for (const double z : {0., 0.3}) {
        for (const auto& [x, y] : {std::array{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
            vertices.push_back({x, y, z});
    }
    write_obj(path, vertices, {{4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// A sky that differs from all sides, and a bright part of it.
void write_panorama(const std::filesystem::path& path) {
    io::Picture sky;
    sky.width = 32, sky.height = 16;
    for (int j = 0; j < sky.height; ++j) {
        for (int i = 0; i < sky.width; ++i) {
            const double value = 1.2 + std::sin(0.2 * i) * std::cos(0.15 * j) + (j == 4 && i == 21 ? 100 : 0);
            const auto y = static_cast<float>(value);
            sky.rgb_cd_m2.push_back({y, 0.9F * y, 0.8F * y});
        }
    }
    replace(path, [&](const std::filesystem::path& unfinished) { io::write_picture(sky, unfinished); });
}

}  // namespace

void write_files(const std::filesystem::path& folder) {
    write_photometry(folder / kCosineFile, "cosine", "0.3 0.1", 1, cosine_cd);
    write_photometry(folder / kBeamFile, "beam", "0 0", 1, beam_cd);
    write_photometry(folder / kWasherFile, "washer", "0.3 0.1", 25, washer_cd);
    write_things(folder);
    write_body(folder / kBodyFile);
    write_panorama(folder / kSkyFile);
}

}  // namespace stilb::random
