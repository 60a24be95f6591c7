#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "io/photometry/photometry_file.h"
#include "io/photometry_support.h"
#include "lights/opening_shape.h"

namespace stilb::io {
namespace {

using namespace photometry_test;
using Classification = FluxAgreement::Classification;

struct Content {
    int symmetry = 0;
    std::vector<double> planes{0, 90, 180, 270};
    std::vector<double> stored{
        2, 4, 8, 10};  ///< intensity [cd/klm] at gamma = 90 of each stored plane; 1 at gamma = 0
    std::vector<std::string> lamps{"1", "A lamp", "1000", "830", "80", "12"};
    int sets = 1;
};

std::string text_of(const Content& content) {
    std::string text = fmt::format("Maker\n1\n{}\n{}\n0\n2\n90\nreport\nLamp two\nnumber\nfile.ldt\n2026\n",
                                   content.symmetry, content.planes.size());
    text += "600\n300\n50\n500\n200\n10\n20\n30\n40\n100\n80\n1\n0\n";
    text += fmt::format("{}\n", content.sets);
    for (int set = 0; set < content.sets; ++set) {
        for (const auto& line : content.lamps) text += line + "\n";
    }
    for (int i = 0; i < 10; ++i) text += "0.5\n";
    for (const double plane : content.planes) text += fmt::format("{}\n", plane);
    text += "0\n90\n";
    for (const double intensity : content.stored) text += fmt::format("1\n{}\n", intensity);
    return text;
}

PhotometricSolid solid_of(const std::string& text) {
    return PhotometricSolid(read_eulumdat(text, "a.ldt").grid);
}

TEST(EulumdatFile, ReadsNamesUnitsAndFactors) {
    const PhotometryFile file = read_eulumdat(text_of({}), "a.ldt");
    EXPECT_EQ(file.format, "EULUMDAT");
    EXPECT_EQ(file.luminaire, "Lamp two, Maker");
    EXPECT_FALSE(file.absolute);
    EXPECT_DOUBLE_EQ(file.lamp_flux_lm, 1000);
    EXPECT_DOUBLE_EQ(file.stated_flux_lm, 800);
    EXPECT_EQ(file.power_w, 12);
    EXPECT_EQ(file.opening_m, (Vec3{0.2, 0.5, 0.04}));
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_DOUBLE_EQ(PhotometricSolid(file.grid).peak_cd(), 10);

    // cd per 1000 lm, times the conversion factor.
    Content strong;
    strong.lamps[2] = "2500";
    EXPECT_DOUBLE_EQ(solid_of(with(text_of(strong), "\n80\n1\n0\n", "\n80\n2\n0\n")).peak_cd(), 10 * 2.5 * 2);
    const PhotometryFile round = read_eulumdat(with(text_of({}), "\n500\n200\n", "\n500\n0\n"), "a.ldt");
    EXPECT_EQ(round.opening_m, (Vec3{-0.5, -0.5, 0.04}));
}

TEST(EulumdatFile, BlankLinesOfWhatIsNotNeededAreReadWithAWarning) {
    const std::string good = text_of({});
    // Distances of planes and angles, the luminous area, the output ratio, the factor and the tilt.
    std::string text = with(good, "\n4\n0\n2\n90\n", "\n4\n\n2\n  \n");
    text = with(text, "500\n200\n10\n20\n30\n40\n100\n80\n1\n0\n", "\n\n\n\n\n\n100\n\n\n\n");
    const PhotometryFile file = read_eulumdat(text, "a.ldt");
    EXPECT_EQ(file.grid.intensity_cd, read_eulumdat(good, "a.ldt").grid.intensity_cd);
    EXPECT_EQ(file.stated_flux_lm, 0);
    EXPECT_TRUE(lights::Opening::of_signed(file.opening_m).is_point());
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("line 5 (distance between C planes) as 0, line 7"), std::string::npos);
    EXPECT_NE(file.warnings[0].find("line 24 (conversion factor for luminous intensities) as 1"),
              std::string::npos);
}

TEST(EulumdatFile, WarnsOfAnglesThatEndElsewhereAndOfNoise) {
    const auto warnings = [](const std::string& from, const std::string& to) {
        return read_eulumdat(with(text_of({}), from, to), "a.ldt").warnings;
    };
    ASSERT_EQ(warnings("270\n0\n90\n", "270\n15\n90\n").size(), 1u);
    EXPECT_NE(warnings("270\n0\n90\n", "270\n0\n60\n")[0].find("the gamma angles run from 0 to 60 degrees"),
              std::string::npos);
    EXPECT_TRUE(warnings("270\n0\n90\n", "270\n0\n180\n").empty());
    EXPECT_EQ(
        warnings("1\n8\n", "-0.1\n8\n"),
        std::vector<std::string>{"1 intensity is negative, down to -0.1 (the largest is 10): read as 0"});
}

TEST(EulumdatFile, NegativeNumberOfLampsIsAbsolutePhotometry) {
    Content content;
    content.lamps[0] = "-1";
    content.lamps[2] = "3000";
    const PhotometryFile file = read_eulumdat(with(text_of(content), "\n100\n80\n", "\n100\n100\n"), "a.ldt");
    EXPECT_TRUE(file.absolute);
    EXPECT_EQ(file.lamp_flux_lm, 0);
    EXPECT_DOUBLE_EQ(file.stated_flux_lm, 3000);
    EXPECT_DOUBLE_EQ(PhotometricSolid(file.grid).peak_cd(), 30);
}

TEST(EulumdatFile, FirstOfSeveralLampSetsIsUsed) {
    Content content;
    content.sets = 3;
    std::string text = text_of(content);
    const PhotometryFile file = read_eulumdat(text, "a.ldt");
    EXPECT_DOUBLE_EQ(file.lamp_flux_lm, 1000);
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("3 alternative sets"), std::string::npos);
}

TEST(EulumdatFile, AcceptsDecimalCommas) {
    Content content;
    content.lamps[2] = "1234,5";
    EXPECT_DOUBLE_EQ(read_eulumdat(text_of(content), "a.ldt").lamp_flux_lm, 1234.5);
}

TEST(EulumdatFile, UnfoldsItsFiveSymmetries) {
    const std::vector<double> eight{0, 45, 90, 135, 180, 225, 270, 315};
    const auto around = [&](int symmetry, const std::vector<double>& stored) {
        const PhotometricSolid solid = solid_of(text_of({symmetry, eight, stored}));
        std::vector<double> result;
        for (const double c : eight)
            result.push_back(std::round(1e6 * solid.intensity_cd(towards(c, 90))) / 1e6);
        return result;
    };
    using Values = std::vector<double>;
    EXPECT_EQ(around(0, {1, 2, 3, 4, 5, 6, 7, 8}), (Values{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(around(1, {9}), Values(8, 9));
    EXPECT_EQ(around(2, {1, 2, 3, 4, 5}), (Values{1, 2, 3, 4, 5, 4, 3, 2}));
    // Stored from C270 over C0 to C90; left and right alike.
    EXPECT_EQ(around(3, {1, 2, 3, 4, 5}), (Values{3, 4, 5, 4, 3, 2, 1, 2}));
    EXPECT_EQ(around(4, {1, 2, 3}), (Values{1, 2, 3, 2, 1, 2, 3, 2}));
}

TEST(EulumdatFile, IsotropicLampHasItsStatedFlux) {
    // 1000 / (4 pi) cd per 1000 lm in all directions: an output ratio of 100 %.
    Content content{1, {0}, {}};
    std::string text = with(text_of(content), "\n100\n80\n", "\n100\n100\n");
    text =
        with(text, "\n0\n90\n", "\n0\n180\n") + fmt::format("{0:.17g}\n{0:.17g}\n", 1000 / (720 * kDegree));
    const PhotometryFile file = read_eulumdat(text, "a.ldt");
    const double integral = PhotometricSolid(file.grid).flux_lm();
    EXPECT_NEAR(integral, 1000, 1e-9);
    EXPECT_EQ(check_flux(file, integral).classification, Classification::Agrees);
}

TEST(EulumdatFile, WrongInputIsNamedWithItsLine) {
    const std::string good = text_of({});
    const auto expect = [](const std::string& text, const std::string& message) {
        expect_message([&] { read_eulumdat(text, "a.ldt"); }, message);
    };
    const auto line_changed = [&](std::size_t line, const std::string& to, const std::string& message) {
        std::size_t start = 0;
        for (std::size_t i = 1; i < line; ++i) start = good.find('\n', start) + 1;
        std::string text = good;
        expect(text.replace(start, good.find('\n', start) - start, to),
               fmt::format("a.ldt:{}: {}", line, message));
    };
    expect("", "a.ldt: the file ends where the company identification should follow");
    line_changed(3, "5", "the symmetry indicator is 5: a whole number from 0 to 4 is required");
    line_changed(4, "0", "the number of C planes is 0");
    line_changed(4, "2000000000", "the number of C planes is 2000000000");
    line_changed(6, "1", "each plane has one intensity");
    line_changed(6, "two",
                 "\"two\" is not a number: the number of intensities in each C plane is expected here");
    line_changed(16, "long", "\"long\" is not a number: the length of the luminous area");
    line_changed(29, "", "\"\" is not a number: the total luminous flux of the lamps");
    line_changed(23, "-80", "the light output ratio is -80 %");
    line_changed(24, "0", "the conversion factor for luminous intensities is 0");
    line_changed(26, "0", "the number of sets of lamps is 0");
    line_changed(26, "1e9", "the number of sets of lamps is");
    line_changed(27, "0.5", "the number of lamps is 0.5");
    line_changed(29, "0", "the total luminous flux of the lamps is 0");
    line_changed(29, "nan", "\"nan\" is not a number");
    line_changed(44, "0", "C angle 0 follows 0");
    line_changed(46, "400", "C angle 400 is out of range");
    line_changed(48, "0", "gamma angle 0 follows 0");
    line_changed(48, "181", "gamma angle 181 is out of range");
    line_changed(50, "-4", "intensity -4 is negative");
    expect(text_of({0, {0, 90}, {-1, 2}}), "intensity -1 is negative");
    line_changed(50, "1e300", "intensity 1e+300 cd (factors included) is too large for a luminaire");
    expect(good + "\n \n12\n", "a.ldt:59: \"12\" follows the last intensity");
    expect(good.substr(0, good.rfind("1\n10")),
           "a.ldt:54: the file ends too early: 8 lines are required for the intensities, 6");
    expect(text_of({2, {0, 90, 180}, {1, 2}}), "symmetry 2 stores 2 of 3 planes, here C0 to C90");
    expect(text_of({4, {0, 80, 180, 270}, {1, 2}}), "they should run from C0 to C90");
    expect(text_of({3, {0, 90, 180, 280}, {1, 2, 3}}), "they should run from C270 to C450");
    for (std::size_t length = 0; length + 3 < good.size(); ++length) {
        EXPECT_THROW(read_eulumdat(good.substr(0, length), "a.ldt"), InputError) << length;
    }
}

TEST(PhotometryFile, IsReadByContent) {
    EXPECT_EQ(read_photometry(text_of({}), "a").format, "EULUMDAT");
    EXPECT_EQ(read_photometry("TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1 0 90 0 1 1", "a").format,
              "IES LM-63-1986");
    const auto expect = [](const std::string& content) {
        expect_message([&] { read_photometry(content, "a.txt"); },
                       "a.txt: not a luminaire file: neither IES LM-63");
    };
    expect("");
    expect("some\ntext\nof\nmany\nlines\nbut\nno\nnumbers\n");
    expect(
        std::string("\x7F"
                    "ELF\0\0\0\n\n\n\n\n",
                    12));
    expect_message([] { read_photometry_file("/nowhere/lamp.ies"); }, "/nowhere/lamp.ies: cannot be read");
    expect_message([] { read_photometry_file("/"); }, "/: cannot be read");
}

/// The set's power is optional, and that of the first set counts.
TEST(EulumdatFile, ReadsThePowerOfTheFirstSet) {
    Content content;
    content.sets = 2;
    for (const auto& [line, power_w] : {std::pair<const char*, std::optional<double>>{"31,5", 31.5},
                                        {"0", std::nullopt},
                                        {"", std::nullopt},
                                        {"2 x 18", std::nullopt}}) {
        content.lamps.back() = line;
        EXPECT_EQ(read_eulumdat(text_of(content), "a.ldt").power_w, power_w) << line;
    }
}

// The files are dummies: their distributions do not have the flux that they state, and the check says so.
TEST(EulumdatFile, RealFilesAreReadAndJudged) {
    const auto folder = shared_photometry() / "ldt";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path());
        const PhotometryFile file = read_photometry_file(entry.path());
        const PhotometricSolid solid(file.grid);
        const double quadrature = midpoint_flux(solid);
        EXPECT_NEAR(solid.flux_lm() / quadrature, 1, 1e-5);
        EXPECT_EQ(file.format, "EULUMDAT");
        EXPECT_EQ(file.luminaire, "Dummy LDT file, ACME Inc.");
        const std::string stem = entry.path().stem().string();
        EXPECT_EQ(file.absolute, stem != "relative" && stem != "multiple_lamp_sets");
        EXPECT_EQ(file.stated_flux_lm, stem.starts_with("symmetry") ? 1000 : 500);
        EXPECT_GT(std::abs(quadrature / file.stated_flux_lm - 1), 0.05);
        EXPECT_EQ(check_flux(file, solid.flux_lm()).classification, Classification::Differs);
        RecordProperty(stem, check_flux(file, solid.flux_lm()).description());
        ++files;
    }
    EXPECT_EQ(files, 6);
}

}  // namespace
}  // namespace stilb::io
