// Large mesh files: how fast they are read, and how much memory that takes at most, as a multiple of the
// mesh's own. Writes the files (some 300 MB) into a temporary folder. Usage: bench_read_mesh [TRIANGLES]
#include <fmt/format.h>
#include <fmt/os.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

#include "geometry/mesh_topology.h"
#include "io/mesh/mesh_file.h"

namespace stilb {
namespace {

namespace fs = std::filesystem;

constexpr double kMega = 1e6;

/// A wavy square of n x n cells, of two triangles each.
class Sheet {
  public:
    explicit Sheet(std::size_t triangles)
        : cells_(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2))) {}

    std::size_t vertex_count() const { return std::size_t{cells_ + 1} * (cells_ + 1); }
    std::size_t triangle_count() const { return std::size_t{2} * cells_ * cells_; }

    template <typename Visitor>
    void for_each_vertex(const Visitor& visit) const {
        constexpr double size_m = 10, waves = 40, height_m = 0.05;
        for (std::uint32_t j = 0; j <= cells_; ++j) {
            for (std::uint32_t i = 0; i <= cells_; ++i) {
                const double u = static_cast<double>(i) / cells_, v = static_cast<double>(j) / cells_;
                visit(Vec3{size_m * u, size_m * v, height_m * std::sin(waves * u) * std::sin(waves * v)});
            }
        }
    }
    template <typename Visitor>
    void for_each_triangle(const Visitor& visit) const {
        for (std::uint32_t j = 0; j < cells_; ++j) {
            for (std::uint32_t i = 0; i < cells_; ++i) {
                const std::uint32_t first = j * (cells_ + 1) + i, above = first + cells_ + 1;
                visit(Triangle{first, first + 1, above + 1});
                visit(Triangle{first, above + 1, above});
            }
        }
    }

  private:
    std::uint32_t cells_;
};

void write_obj(const Sheet& sheet, const fs::path& path) {
    fmt::ostream file = fmt::output_file(path.c_str());
    sheet.for_each_vertex([&](const Vec3& v) { file.print("v {:.6f} {:.6f} {:.6f}\n", v.x, v.y, v.z); });
    sheet.for_each_triangle(
        [&](const Triangle& t) { file.print("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1); });
}

std::string ply_header(const Sheet& sheet, std::string_view format) {
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        format, sheet.vertex_count(), sheet.triangle_count());
}

void write_text_ply(const Sheet& sheet, const fs::path& path) {
    fmt::ostream file = fmt::output_file(path.c_str());
    file.print("{}", ply_header(sheet, "ascii"));
    sheet.for_each_vertex([&](const Vec3& v) { file.print("{:.6f} {:.6f} {:.6f}\n", v.x, v.y, v.z); });
    sheet.for_each_triangle([&](const Triangle& t) { file.print("3 {} {} {}\n", t[0], t[1], t[2]); });
}

void write_binary_ply(const Sheet& sheet, const fs::path& path) {
    static_assert(std::endian::native == std::endian::little);
    std::ofstream file(path, std::ios::binary);
    file << ply_header(sheet, "binary_little_endian");
    sheet.for_each_vertex([&](const Vec3& v) {
        const std::array position{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        file.write(reinterpret_cast<const char*>(position.data()), sizeof(position));
    });
    sheet.for_each_triangle(
        [&](const Triangle& t) { file.put(3).write(reinterpret_cast<const char*>(t.data()), sizeof(t)); });
    if (!file.flush()) throw std::runtime_error("the file could not be written");
}

double processor_s() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<double>(usage.ru_maxrss);
}

/// Calls the work in a process of its own, so that its peak of memory is its own.
void in_own_process(const std::function<void()>& work) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        work();
        std::fflush(stdout);
        _exit(EXIT_SUCCESS);
    }
    int status = EXIT_FAILURE;
    if (child < 0 || waitpid(child, &status, 0) < 0 || status != EXIT_SUCCESS)
        throw std::runtime_error("a measurement failed");
}

void measure(const fs::path& path) {
    const double file_bytes = static_cast<double>(fs::file_size(path));
    const double before_bytes = peak_bytes(), start_s = processor_s();
    io::MeshFile file = io::read_mesh_file(path);
    const double read_s = processor_s() - start_s, read_bytes = peak_bytes();
    const Mesh& mesh = file.mesh;
    const double mesh_bytes =
        static_cast<double>(mesh.vertices.size() * sizeof(Vec3) + mesh.triangles.size() * sizeof(Triangle));
    // As `stilb info` does.
    std::vector<std::uint32_t>().swap(file.material_of_triangle);
    std::vector<std::uint32_t>().swap(file.group_of_triangle);
    const double check_start_s = processor_s();
    const std::size_t open_edges = find_components(mesh).total_open_edges();
    fmt::print(
        "{:16} {:8.1f} {:8.2f} {:8.0f} {:9.1f} {:9.1f} {:7.2f} {:9.2f} {:9.2f}   {} triangles, {} open "
        "edges\n",
        path.filename().string(), file_bytes / kMega, read_s, file_bytes / kMega / read_s, mesh_bytes / kMega,
        (read_bytes - before_bytes) / kMega, read_bytes / mesh_bytes, processor_s() - check_start_s,
        peak_bytes() / mesh_bytes, mesh.triangles.size(), open_edges);
}

int run(std::size_t triangles) {
    const fs::path folder = fs::temp_directory_path() / fmt::format("stilb-bench-{}", getpid());
    fs::create_directory(folder);
    const Sheet sheet(triangles);
    write_obj(sheet, folder / "sheet.obj");
    write_text_ply(sheet, folder / "text.ply");
    write_binary_ply(sheet, folder / "binary.ply");
    fmt::print("Reading mesh files; processor time; peak: all memory of the process over the mesh's\n");
    fmt::print("{:16} {:>8} {:>8} {:>8} {:>9} {:>9} {:>7} {:>9} {:>9}\n", "file", "MB", "read s", "MB/s",
               "mesh MB", "added MB", "peak", "checks s", "peak");
    for (const char* const name : {"sheet.obj", "text.ply", "binary.ply"})
        in_own_process([&] { measure(folder / name); });
    fs::remove_all(folder);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace stilb

int main(int argc, char** argv) {
    return stilb::run(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 5'000'000);
}
