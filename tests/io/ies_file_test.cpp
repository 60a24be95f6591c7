#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "io/photometry/photometry_file.h"
#include "io/photometry_support.h"

namespace stilb::io {
namespace {

using namespace photometry_test;
using Classification = FluxAgreement::Classification;

// Type C, one lamp of 1000 lm, metres; three vertical angles and two planes (a quarter).
const std::string kFile =
    "IESNA:LM-63-2002\n"
    "[TEST] 17\n"
    "[MANUFAC] Maker\n"
    "[LUMINAIRE] Lamp one\n"
    "TILT=NONE\n"
    "1 1000 2 3 2 1 2 0.3 0.6 0.1\n"
    "0.5 1 40\n"
    "0 45 90\n"
    "0 90\n"
    "100 80 10\n"
    "100 60 0\n";

PhotometricSolid solid_of_ies(const std::string& text) {
    return PhotometricSolid(read_ies(text, "a.ies").grid);
}

TEST(IesFile, ReadsNamesUnitsAndFactors) {
    const PhotometryFile file = read_ies(kFile, "a.ies");
    EXPECT_EQ(file.format, "IES LM-63-2002");
    EXPECT_EQ(file.luminaire, "Lamp one, Maker");
    EXPECT_FALSE(file.absolute);
    EXPECT_DOUBLE_EQ(file.lamp_flux_lm, 500);
    EXPECT_EQ(file.stated_flux_lm, 0);
    EXPECT_EQ(file.power_w, 40);
    EXPECT_EQ(read_ies(with(kFile, "0.5 1 40", "0.5 1 0"), "a.ies").power_w, std::nullopt);
    EXPECT_EQ(read_ies(with(kFile, "0.5 1 40", "0.5 1 -1"), "a.ies").power_w, std::nullopt);
    EXPECT_EQ(file.opening_m, (Vec3{0.6, 0.3, 0.1}));
    EXPECT_TRUE(file.warnings.empty());
    const PhotometricSolid solid(file.grid);
    EXPECT_DOUBLE_EQ(solid.peak_cd(), 100 * 2 * 0.5);

    const PhotometryFile feet = read_ies(with(kFile, "1 2 0.3 0.6", "1 1 -0.3 0.6"), "a.ies");
    EXPECT_NEAR(feet.opening_m.y, -0.3 * 0.3048, 1e-15);
    EXPECT_NEAR(feet.opening_m.x, -0.6 * 0.3048, 1e-15);  // one sign makes an ellipse
}

TEST(IesFile, KnowsWhichNumbersAreFactorsInWhichVersion) {
    const std::string with_second = with(kFile, "0.5 1 40", "0.5 0.8 40");
    const auto version = [&](const std::string& header) {
        return with(with_second, "IESNA:LM-63-2002\n", header);
    };
    const auto peak = [](const std::string& text) { return solid_of_ies(text).peak_cd(); };
    EXPECT_DOUBLE_EQ(peak(version("")), 80);  // 1986
    EXPECT_DOUBLE_EQ(peak(version("IESNA91\n")), 80);
    EXPECT_DOUBLE_EQ(peak(version("IESNA:LM-63-1995\n")), 100);
    EXPECT_DOUBLE_EQ(peak(version("IESNA:LM-63-2002\n")), 100);
    EXPECT_DOUBLE_EQ(peak(with(version("IES:LM-63-2019\n"), "0.8", "1.10001")), 100);
    EXPECT_EQ(read_ies(version(""), "a").format, "IES LM-63-1986");
    EXPECT_EQ(read_ies(version("IESNA91\n"), "a").format, "IES LM-63-1991");
    EXPECT_EQ(read_ies(version("IES:LM-63-2019\n"), "a").format, "IES LM-63-2019");
    EXPECT_EQ(read_ies(version("IESNA91\n"), "a").lamp_flux_lm, 400);
    ASSERT_EQ(read_ies(version("IESNA:LM-63-1995\n"), "a").warnings.size(), 1u);
    EXPECT_TRUE(read_ies(version("IES:LM-63-2019\n"), "a").warnings.empty());
}

TEST(IesFile, KnowsItsVersionInOtherSpellings) {
    const auto read = [](const std::string& first_line) {
        return read_ies(with(kFile, "IESNA:LM-63-2002", first_line), "a.ies");
    };
    const auto expect = [&](const std::string& first_line, const std::string& format) {
        EXPECT_EQ(read(first_line).format, format) << first_line;
        EXPECT_TRUE(read(first_line).warnings.empty()) << first_line;
    };
    expect("IESNA LM-63-2002", "IES LM-63-2002");
    expect("IESNA: LM-63-2002", "IES LM-63-2002");
    expect("iesna:lm-63-2002 ", "IES LM-63-2002");
    expect("\nIESNA:LM-63-2002", "IES LM-63-2002");
    expect("ANSI/IES LM-63-19", "IES LM-63-2019");
    expect("ANSI/IESNA:LM-63-02", "IES LM-63-2002");
    expect("IES:LM-63-2019", "IES LM-63-2019");
    expect("IESNA:LM-63-91", "IES LM-63-1991");
    expect("LM-63-1995", "IES LM-63-1995");
    expect("IESNA86", "IES LM-63-1986");
    // Of lamps and places, not of a version.
    for (const char* name : {"IES downlight 1986", "Maker 2002", "63 LM lamp"})
        expect(name, "IES LM-63-1986");
    for (const char* unknown : {"IESNA:LM-63-2012", "IES:LM-63-2025", "by Exporter: LM-63-2002", "IESNA:"}) {
        const PhotometryFile file = read(unknown);
        EXPECT_EQ(file.format, "IES LM-63-2002");
        ASSERT_EQ(file.warnings.size(), 1u) << unknown;
        EXPECT_NE(file.warnings[0].find("names no known version"), std::string::npos);
    }
}

/// The tables of luminous openings: those of LM-63-1995 (as I. Ashdown, Parsing the IESNA LM-63 photometric
/// data file, 1998, gives them, for 1986 and 1991 too) and of LM-63-2002, written with the signs of 2002.
TEST(IesFile, ReadsOpeningsByTheTableOfTheirVersion) {
    const auto opening = [](const std::string& version, const std::string& numbers) {
        const std::string text = with(kFile, "0.3 0.6 0.1", numbers);
        return read_ies(with(text, "IESNA:LM-63-2002", version), "a.ies").opening_m;
    };
    for (const char* old : {"Lantern", "IESNA91", "IESNA:LM-63-1995"}) {
        SCOPED_TRACE(old);  // width, length, height; the result has the length first
        EXPECT_EQ(opening(old, "0 0 0"), (Vec3{0, 0, 0}));
        EXPECT_EQ(opening(old, "0.3 0.6 0.1"), (Vec3{0.6, 0.3, 0.1}));
        EXPECT_EQ(opening(old, "-0.2 0 0"), (Vec3{-0.2, -0.2, 0}));          // circle
        EXPECT_EQ(opening(old, "-0.2 0 0.1"), (Vec3{-0.2, -0.2, 0.1}));      // vertical cylinder
        EXPECT_EQ(opening(old, "-0.2 0 -0.2"), (Vec3{-0.2, -0.2, -0.2}));    // sphere
        EXPECT_EQ(opening(old, "0 1.2 -0.1"), (Vec3{1.2, -0.1, -0.1}));      // tube along the length
        EXPECT_EQ(opening(old, "1.2 0 -0.1"), (Vec3{-0.1, 1.2, -0.1}));      // tube along the width
        EXPECT_EQ(opening(old, "-0.3 0.9 0"), (Vec3{-0.9, -0.3, 0}));        // ellipse along the length
        EXPECT_EQ(opening(old, "0.9 -0.3 0.1"), (Vec3{-0.3, -0.9, 0.1}));    // ellipse along the width
        EXPECT_EQ(opening(old, "-0.3 0.9 -0.2"), (Vec3{-0.9, -0.3, -0.2}));  // ellipsoids
        EXPECT_EQ(opening(old, "0.9 -0.3 -0.2"), (Vec3{-0.3, -0.9, -0.2}));
    }
    for (const char* newer : {"IESNA:LM-63-2002", "IES:LM-63-2019"}) {
        SCOPED_TRACE(newer);
        EXPECT_EQ(opening(newer, "-0.2 -0.2 -0.2"), (Vec3{-0.2, -0.2, -0.2}));
        EXPECT_EQ(opening(newer, "-0.1 1.2 -0.1"), (Vec3{1.2, -0.1, -0.1}));  // tubes
        EXPECT_EQ(opening(newer, "1.2 -0.1 -0.1"), (Vec3{-0.1, 1.2, -0.1}));
        EXPECT_EQ(opening(newer, "-0.2 0 -0.2"), (Vec3{0, -0.2, -0.2}));  // a vertical circle that faces C0
        EXPECT_EQ(opening(newer, "-0.2 0 0"), (Vec3{-0.2, -0.2, 0}));     // only in the older tables
        EXPECT_EQ(opening(newer, "0 1.2 -0.1"), (Vec3{1.2, -0.1, -0.1}));
    }
}

TEST(IesFile, WarnsOfVerticalAnglesThatEndElsewhere) {
    const auto warnings = [](const std::string& angles) {
        return read_ies(with(kFile, "0 45 90\n", angles + "\n"), "a.ies").warnings;
    };
    for (const char* whole : {"0 45 90", "0 45 180", "90 135 180", "0 45 89.9999999"})
        EXPECT_TRUE(warnings(whole).empty()) << whole;
    for (const char* part : {"15 45 90", "0 45 60", "0 45 89.9", "0.1 45 90", "90 100 170"}) {
        ASSERT_EQ(warnings(part).size(), 1u) << part;
        EXPECT_NE(warnings(part)[0].find("LM-63 wants them to run from 0 or 90 to 90 or 180"),
                  std::string::npos);
    }
    const std::string of_b = "TILT=NONE\n1 -1 1 2 2 2 2 0 0 0 1 1 1 ";
    EXPECT_TRUE(read_ies(of_b + "-90 90 0 90 1 1 1 1", "a.ies").warnings.empty());
    EXPECT_TRUE(read_ies(of_b + "0 90 0 90 1 1 1 1", "a.ies").warnings.empty());
    EXPECT_EQ(read_ies(of_b + "-60 60 0 90 1 1 1 1", "a.ies").warnings.size(), 1u);
}

TEST(IesFile, NegativeNoiseIsReadAsDarkness) {
    const PhotometryFile file =
        read_ies(with(kFile, "100 80 10\n100 60 0", "100 80 -0.3\n100 60 -1"), "a.ies");
    EXPECT_EQ(*std::ranges::min_element(file.grid.intensity_cd), 0);
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_EQ(file.warnings[0], "2 intensities are negative, down to -1 (the largest is 100): read as 0");
}

TEST(IesFile, WarnsOfOpeningsInAnotherUnit) {
    const auto warning = [](const std::string& size) {
        return opening_warning(read_ies(with(kFile, "0.3 0.6 0.1", size), "a.ies"));
    };
    EXPECT_NE(warning("600 600 0").value_or("").find("the luminous opening is 600 m large"),
              std::string::npos);
    EXPECT_NE(warning("-0.0003 0 0").value_or("").find("the luminous opening is 0.0003 m large"),
              std::string::npos);
    EXPECT_TRUE(warning("0.0049 0.001 0"));
    EXPECT_FALSE(warning("0.005 0.001 0"));
    EXPECT_FALSE(warning("0.3 10 0"));
    EXPECT_TRUE(warning("0.3 10.01 0"));
    EXPECT_FALSE(warning("0 0 0"));
}

TEST(IesFile, NameOf1986IsItsFirstLine) {
    const std::string text = "Old lantern\nsecond line\n" + kFile.substr(kFile.find("TILT"));
    EXPECT_EQ(read_ies(text, "a.ies").luminaire, "Old lantern");
}

TEST(IesFile, SeparatorsAndLineEndsAreFree) {
    std::string text = kFile.substr(0, kFile.find("1 1000"));
    text +=
        "1,1000,2 , 3\r\n2\r\n1\t2 0.3\r\n\r\n0.6,0.1 0.5,1,40 0,45,90,0,90 100,80\r\n,10 +1.0e2 60 "
        "0\r\n\x1A";
    const PhotometryFile expected = read_ies(kFile, "a.ies"),
                         found = read_ies("\xEF\xBB\xBF" + text, "a.ies");
    EXPECT_EQ(found.format, expected.format);
    EXPECT_EQ(found.grid.planes_deg, expected.grid.planes_deg);
    EXPECT_EQ(found.grid.intensity_cd, expected.grid.intensity_cd);
    std::string old_mac = kFile;
    std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
    EXPECT_EQ(read_ies(old_mac, "a.ies").grid.intensity_cd, expected.grid.intensity_cd);
}

TEST(IesFile, UnfoldsTheSymmetriesOfTypeC) {
    const auto with_planes = [](const std::string& count, const std::string& rest) {
        return "TILT=NONE\n1 -1 1 2 " + count + " 1 2 0 0 0 1 1 1\n0 90\n" + rest;
    };
    // Intensity at gamma = 90 in eight planes: 45 degrees apart, from C0 on.
    const auto around = [](const std::string& text) {
        const PhotometricSolid solid = solid_of_ies(text);
        std::vector<double> result;
        for (int c = 0; c < 360; c += 45) {
            result.push_back(std::round(1e6 * solid.intensity_cd(towards(c, 90))) / 1e6);
        }
        return result;
    };
    using Values = std::vector<double>;
    EXPECT_EQ(around(with_planes("1", "0 1 5")), (Values{5, 5, 5, 5, 5, 5, 5, 5}));
    EXPECT_EQ(around(with_planes("2", "0 90 1 2 1 4")), (Values{2, 3, 4, 3, 2, 3, 4, 3}));
    EXPECT_EQ(around(with_planes("3", "0 90 180 1 2 1 4 1 8")), (Values{2, 3, 4, 6, 8, 6, 4, 3}));
    EXPECT_EQ(around(with_planes("3", "90 180 270 1 2 1 4 1 8")), (Values{4, 3, 2, 3, 4, 6, 8, 6}));
    EXPECT_EQ(around(with_planes("5", "0 90 180 270 360 1 2 1 4 1 8 1 10 1 2")),
              (Values{2, 3, 4, 6, 8, 9, 10, 6}));
    EXPECT_EQ(around(with_planes("4", "0 90 180 270 1 2 1 4 1 8 1 10")), (Values{2, 3, 4, 6, 8, 9, 10, 6}));
}

// H turns clockwise seen from above: H = 90 is C270.
TEST(IesFile, PlacesTypesAAndB) {
    const std::string numbers = " 1 2 0 0 0 1 1 1\n-90 0 90\n-90 0 90\n1 2 3 4 5 6 7 8 9\n";
    const auto text = [&](const char* type) {
        return "TILT=NONE\n1 -1 1 3 3 " + std::string(type) + numbers.substr(2);
    };
    const PhotometricSolid a = solid_of_ies(text("3"));  // planes of H: vertical angles -90, 0, 90 in each
    EXPECT_NEAR(a.intensity_cd(towards(0, 90)), 5, 1e-12);
    EXPECT_NEAR(a.intensity_cd(towards(90, 90)), 2, 1e-12);
    EXPECT_NEAR(a.intensity_cd(towards(270, 90)), 8, 1e-12);
    EXPECT_EQ(a.intensity_cd(towards(180, 90)), 0);
    EXPECT_NEAR(a.intensity_cd(towards(0, 1e-9)), 4, 1e-9);
    EXPECT_NEAR(a.intensity_cd(towards(0, 180 - 1e-9)), 6, 1e-9);
    const PhotometricSolid b = solid_of_ies(text("2"));  // V = 0 is the nadir, V = 90 is C0, H = 90 is C270
    EXPECT_NEAR(b.intensity_cd({0, 0, 1}), 5, 1e-12);
    EXPECT_NEAR(b.intensity_cd(towards(0, 90)), 6, 1e-12);
    EXPECT_NEAR(b.intensity_cd(towards(180, 90)), 4, 1e-12);
    EXPECT_NEAR(b.intensity_cd(towards(270, 90 - 1e-6)), 8, 1e-6);
    EXPECT_NEAR(b.intensity_cd(towards(90, 90 - 1e-6)), 2, 1e-6);
}

TEST(IesFile, MirrorsTypesAAndBThatStartAtZero) {
    for (const char* type : {"2", "3"}) {
        const std::string start = "TILT=NONE\n1 -1 1 3 ",
                          middle = std::string(" ") + type + " 2 0 0 0 1 1 1\n";
        const PhotometryFile half = read_ies(start + "2" + middle + "-45 0 45 0 60 1 2 3 4 5 6", "half");
        const PhotometryFile full =
            read_ies(start + "3" + middle + "-45 0 45 -60 0 60 4 5 6 1 2 3 4 5 6", "full");
        EXPECT_EQ(half.grid.planes_deg, full.grid.planes_deg);
        EXPECT_EQ(half.grid.polar_deg, full.grid.polar_deg);
        EXPECT_EQ(half.grid.intensity_cd, full.grid.intensity_cd);
    }
}

TEST(IesFile, TiltIsReadAndReported) {
    const auto tilted = [](const std::string& tilt) { return with(kFile, "TILT=NONE\n", tilt); };
    const PhotometryFile included = read_ies(tilted("TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n"), "a.ies");
    EXPECT_EQ(included.grid.intensity_cd, read_ies(kFile, "a.ies").grid.intensity_cd);
    ASSERT_EQ(included.warnings.size(), 1u);
    EXPECT_NE(included.warnings[0].find("TILT=INCLUDE"), std::string::npos);
    EXPECT_EQ(read_ies(tilted("TILT=other.tlt\n"), "a.ies").warnings.size(), 1u);
    const auto expect = [&](const std::string& tilt, const std::string& message) {
        expect_message([&] { read_ies(tilted(tilt), "a.ies"); }, message);
    };
    expect("TILT=\n", "TILT= must be NONE, INCLUDE or the name of a file");
    expect("TILT=INCLUDE\n4\n1\n0\n1\n", "a.ies:6: the lamp-to-luminaire geometry of TILT is 4");
    expect("TILT=INCLUDE\n1\n2\n45 0\n1 1\n", "a.ies:8: TILT angle 0 follows 45");
    expect("TILT=INCLUDE\n1\n2\n0 45\n1 -1\n", "a.ies:9: TILT factor -1 is negative");
    expect("TILT=INCLUDE\n1\n1000000000\n", "the number of TILT angles is 1000000000");
}

TEST(IesFile, NamesAreMadePrintable) {
    const auto name = [](const std::string& text) {
        return read_ies(with(kFile, "Lamp one", text), "a.ies").luminaire;
    };
    EXPECT_EQ(name("Gl\xFChlampe"), "Gl\xC3\xBChlampe, Maker");      // Latin-1
    EXPECT_EQ(name("Gl\xC3\xBChlampe"), "Gl\xC3\xBChlampe, Maker");  // UTF-8
    EXPECT_EQ(name("a\x1B[2Jb"), "a [2Jb, Maker");
}

TEST(IesFile, WrongInputIsNamedWithItsLine) {
    const auto expect = [](const std::string& text, const std::string& message) {
        expect_message([&] { read_ies(text, "a.ies"); }, message);
    };
    const auto changed = [&](const std::string& from, const std::string& to, const std::string& message) {
        expect(with(kFile, from, to), message);
    };
    expect("", "a.ies: the line TILT= is missing");
    expect("no photometry\nat all\n", "a.ies:2: the line TILT= is missing");
    changed("1 1000", "1.5 1000", "a.ies:6: the number of lamps is 1.5: a whole number");
    changed("1 1000", "1 -7", "a.ies:6: the lumens per lamp are -7");
    changed("1000 2 3", "1000 0 3", "a.ies:6: the candela multiplier is 0");
    changed("2 3 2 1 2", "2 3 2 4 2", "a.ies:6: the photometric type (1: C, 2: B, 3: A) is 4");
    changed("2 3 2 1 2", "2 3 2 1 3", "a.ies:6: the unit of length (1: feet, 2: metres) is 3");
    changed("2 3 2 1 2", "2 900000000 2 1 2", "a.ies:6: the number of vertical angles is 900000000");
    changed("2 3 2 1 2", "2 3 -2 1 2", "a.ies:6: the number of horizontal angles is -2");
    changed("2 3 2 1 2", "2 1 2 1 2", "a.ies:7: there is one vertical angle");
    changed("0.5 1 40", "0 1 40", "a.ies:7: the ballast factor is 0");
    changed("0.5 1 40", "0.5 1 watts",
            "a.ies:7: \"watts\" is not a number: the input watts is expected here");
    changed("0 45 90", "0 45 45", "a.ies:8: vertical angle 45 follows 45");
    changed("0 45 90", "0 45 200", "a.ies:8: vertical angle 200 is out of range");
    changed("0 45 90", "0 nan 90", "a.ies:8: \"nan\" is not a number");
    changed("\n0 90\n", "\n0 100\n", "a.ies:9: the horizontal angles run from 0 to 100");
    changed("\n0 90\n", "\n90 0\n", "a.ies:9: horizontal angle 0 follows 90");
    changed("100 80 10", "100 -1.01 10", "a.ies:10: intensity -1.01 is negative");
    changed("100 80 10", "100 1e300 10", "too large for a luminaire");
    changed("100 80 10", "100 1e999 10", "a.ies:10: \"1e999\" is not a number");
    changed("100 80 10",
            "100 8\x01\xFF"
            "0 10",
            "is not a number");
    changed("100 60 0\n", "100 60\n",
            "a.ies:11: the file ends too early: 6 numbers are required for the intensities, 5");
    changed("100 60 0\n", "100 60 0\n7 8\n", "a.ies:12: 2 numbers more than the counts of angles allow");
    changed("100 80 10\n100 60 0\n", "0 0 0 0 0 0", "a.ies: all intensities are 0");
    expect("TILT=NONE\n1 -1 1 2 1 2 2 0 0 0 1 1 1 0 90 0 1 1", "one horizontal angle: types A and B");
    expect("TILT=NONE\n1 -1 1 2 2 2 2 0 0 0 1 1 1 0 90 10 20 1 1 1 1", "the horizontal angles start at 10");
    // Cut anywhere before the last number: always an error, never a crash.
    for (std::size_t length = 0; length + 3 < kFile.size(); ++length) {
        EXPECT_THROW(read_ies(kFile.substr(0, length), "a.ies"), InputError) << length;
    }
}

TEST(IesFile, SaysWhatTheFluxAgreesWith) {
    PhotometryFile file;
    EXPECT_EQ(check_flux(file, 10).classification, Classification::NothingStated);
    file.lamp_flux_lm = 1000;
    EXPECT_EQ(check_flux(file, 700).classification, Classification::BelowLampFlux);
    EXPECT_EQ(check_flux(file, 700).description(), "the integral, 700 lm, is 70.0 % of the lamps' 1000 lm");
    EXPECT_EQ(check_flux(file, 1100).classification, Classification::AboveLampFlux);
    file.stated_flux_lm = 800;
    EXPECT_EQ(check_flux(file, 790).classification, Classification::Agrees);
    EXPECT_EQ(check_flux(file, 700).description(),
              "file and integral differ: the integral, 700 lm, is 12.5 % below the stated 800 lm");
}

// The files are dummies: all have one distribution, whose flux is about 905 lm, and state 500 lm or nothing.
TEST(IesFile, RealFilesAreReadAndJudged) {
    const auto folder = shared_photometry() / "ies";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path());
        const PhotometryFile file = read_photometry_file(entry.path());
        const PhotometricSolid solid(file.grid);
        const double quadrature = midpoint_flux(solid);
        EXPECT_NEAR(solid.flux_lm() / quadrature, 1, 1e-5);
        EXPECT_EQ(file.format, "IES LM-63-1995");
        EXPECT_EQ(file.luminaire.substr(0, 14), "Dummy IES file");
        const bool relative = entry.path().filename().string().starts_with("relative");
        EXPECT_EQ(file.absolute, !relative);
        EXPECT_EQ(file.lamp_flux_lm, relative ? 500 : 0);
        const Classification expected = !relative                 ? Classification::NothingStated
                                        : quadrature > 500 * 1.02 ? Classification::AboveLampFlux
                                                                  : Classification::BelowLampFlux;
        EXPECT_EQ(check_flux(file, solid.flux_lm()).classification, expected);
        RecordProperty(entry.path().stem().string(), check_flux(file, solid.flux_lm()).description());
        ++files;
    }
    EXPECT_EQ(files, 9);
    const auto opening = [&](const char* name) { return read_photometry_file(folder / name).opening_m; };
    EXPECT_NEAR(opening("imperial_units.ies").x, 0.34 * 0.3048, 1e-15);
    EXPECT_EQ(opening("metric_units.ies"), (Vec3{0.34, 0.12, 0.56}));
    EXPECT_EQ(opening("round_opening.ies").y, -0.12);
}

}  // namespace
}  // namespace stilb::io
