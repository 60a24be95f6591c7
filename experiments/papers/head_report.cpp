#include "papers/head_report.h"

#include <fmt/format.h>

#include <functional>
#include <numbers>

namespace stilb::papers {
namespace {

constexpr double kPercent = 100, kDegrees = 180 / std::numbers::pi;

using Number = std::function<double(const HeadSeries&)>;

std::vector<double> of_each(const HeadStudy& study, const Number& number) {
    std::vector<double> numbers;
    for (const HeadSeries& one : study.series) numbers.push_back(number(one));
    return numbers;
}

/// Over the degrees from 1 to the highest.
Series curve(const cli::FitReport& report, const std::string& name,
             const std::function<double(int)>& number) {
    Series series{name, {}, {}};
    for (int degree = 1; degree <= report.degree(); ++degree) {
        series.x.push_back(degree);
        series.y.push_back(number(degree));
    }
    return series;
}

/// Over those that there are pictures of.
Series points(const HeadStudy& study, const std::string& name, const Number& number) {
    Series series{name, of_each(study, [](const HeadSeries& one) { return one.degree; }),
                  of_each(study, number)};
    series.marker = MarkerStyle::circle;
    return series;
}

}  // namespace

std::string to_text(const HeadStudy& study) {
    const cli::FitReport& report = study.report;
    std::string text = fmt::format(
        "{}: {} vertices, {} faces; {} bytes as bare vertices and faces\n"
        "\n"
        "        distances [% of the size]           mesh / series  luminances [%]    normals      time\n"
        "degree       rms     largest       bytes    of bytes   difference  noise     rms [°]  series / "
        "mesh\n",
        report.mesh, report.vertices, report.faces, report.bare_mesh_bytes());
    for (const HeadSeries& one : study.series) {
        text +=
            fmt::format("{:6}  {:8.3g}  {:10.3g}  {:10}  {:10.4g}  {:11.3g}  {:5.2g}  {:10.3g}  {:13.3g}\n",
                        one.degree, kPercent * report.rms_error(one.degree),
                        kPercent * report.largest_error(one.degree), cli::FitReport::bare_bytes(one.degree),
                        report.bare_ratio(one.degree), kPercent * one.luminance_difference,
                        kPercent * one.noise, kDegrees * one.normal_error_rad, study.time_ratio(one));
    }
    text += fmt::format(
        "luminances and normals over the {:.0f} % of the pixels that show the head; noise is part of the "
        "difference\n"
        "the mesh's picture takes {:.2f} s of processor time, {:.2f} s of it for the ray caster's set-up; "
        "the series' set-ups:",
        kPercent * study.head_share, study.mesh.processor_s, study.mesh.set_up_s);
    for (const HeadSeries& one : study.series) text += fmt::format(" {:.2f}", one.rendered.set_up_s);
    return text + fmt::format(
                      " s\n"
                      "in the view of the whole room, degree {} takes {:.3g} times the mesh's time\n",
                      study.room_degree, study.room_time_ratio());
}

std::vector<io::Column> columns_of(const HeadStudy& study) {
    const cli::FitReport& report = study.report;
    const auto column = [&](const char* name, const Number& number) {
        return io::Column{name, of_each(study, number)};
    };
    const auto bytes = static_cast<double>(report.bare_mesh_bytes());
    return {column("degree", [](const HeadSeries& one) { return one.degree; }),
            column("rms_error", [&](const HeadSeries& one) { return report.rms_error(one.degree); }),
            column("largest_error", [&](const HeadSeries& one) { return report.largest_error(one.degree); }),
            column("bytes",
                   [](const HeadSeries& one) {
                       return static_cast<double>(cli::FitReport::bare_bytes(one.degree));
                   }),
            column("mesh_bytes", [&](const HeadSeries&) { return bytes; }),
            column("storage_ratio", [&](const HeadSeries& one) { return report.bare_ratio(one.degree); }),
            column("luminance_difference", [](const HeadSeries& one) { return one.luminance_difference; }),
            column("noise", [](const HeadSeries& one) { return one.noise; }),
            column("normal_error_deg", [](const HeadSeries& one) { return kDegrees * one.normal_error_rad; }),
            column("time_s", [](const HeadSeries& one) { return one.rendered.processor_s; }),
            column("mesh_time_s", [&](const HeadSeries&) { return study.mesh.processor_s; }),
            column("time_ratio", [&](const HeadSeries& one) { return study.time_ratio(one); }),
            column("set_up_s", [](const HeadSeries& one) { return one.rendered.set_up_s; }),
            column("mesh_set_up_s", [&](const HeadSeries&) { return study.mesh.set_up_s; })};
}

Plot plot_of(const HeadStudy& study) {
    const cli::FitReport& report = study.report;
    PlotPanel errors{{"error", plot::ScaleType::logarithmic}, {}, 320};
    errors.series = {curve(report, "distance, rms [% of the size]",
                           [&](int degree) { return kPercent * report.rms_error(degree); }),
                     curve(report, "distance, largest [% of the size]",
                           [&](int degree) { return kPercent * report.largest_error(degree); }),
                     points(study, "luminance [%]",
                            [](const HeadSeries& one) { return kPercent * one.luminance_difference; }),
                     points(study, "normals, rms [°]",
                            [](const HeadSeries& one) { return kDegrees * one.normal_error_rad; })};
    PlotPanel bytes{{"bytes, mesh / series", plot::ScaleType::logarithmic}, {}, 180};
    bytes.series = {curve(report, "", [&](int degree) { return report.bare_ratio(degree); })};
    return {"A head as a series of spherical harmonics",
            {"degree", plot::ScaleType::logarithmic},
            {errors, bytes}};
}

}  // namespace stilb::papers
