#include "io/mesh/harmonics_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/text/table.h"
#include "math/spherical_harmonics.h"
#include "stilb/error.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

HarmonicsFile sample(int degree) {
    HarmonicsFile file;
    for (std::size_t i = 0; i < math::harmonic_count(degree); ++i)
        file.coefficients.push_back(
            static_cast<float>(std::sin(1.7 * static_cast<double>(i)) / (1 + static_cast<double>(i))));
    file.center = {0.1, -2.5e-7, 1.0 / 3};
    return file;
}

std::string refusal(const std::string& content) {
    try {
        parse_harmonics(content, "a.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

/// A valid file of degree 0, with something else in the place of one part.
std::string with(const std::string& part, const std::string& other) {
    std::string text =
        R"({"format": "stilb-harmonics", "version": 1, "degree": 0, "center": [0, 1, 2], "coefficients": [3.5]})";
    const std::size_t place = text.find(part);
    EXPECT_NE(place, std::string::npos) << part;
    return text.replace(place, part.size(), other);
}

void expect_refusal(const std::string& content, const std::vector<std::string>& parts) {
    const std::string message = refusal(content);
    EXPECT_TRUE(message.starts_with("a.json:")) << message;
    for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
}

TEST(HarmonicsFile, IsReadAsItWasWritten) {
    for (const int degree : {0, 1, 7, math::kMostHarmonicDegree}) {
        HarmonicsFile file = sample(degree);
        file.mesh = "a \"strange\" \n name";
        file.rms_error = 0.00125;
        const HarmonicsFile read = parse_harmonics(to_text(file), "a.json");
        ASSERT_EQ(read.coefficients.size(), file.coefficients.size());
        for (std::size_t i = 0; i < read.coefficients.size(); ++i)
            ASSERT_EQ(static_cast<float>(read.coefficients[i]), static_cast<float>(file.coefficients[i]))
                << i;
        EXPECT_EQ(read.center, file.center);
        EXPECT_EQ(read.mesh, file.mesh);
        EXPECT_EQ(read.rms_error, file.rms_error);
    }
}

TEST(HarmonicsFile, HasCoefficientsInTheirFewestDigits) {
    HarmonicsFile file{{3.14159265358979, 0.1, -1e-9, 0}, {}};
    const std::string text = to_text(file);
    EXPECT_NE(text.find("\n3.1415927,\n0.1, -1e-09, 0\n]"), std::string::npos) << text;
    EXPECT_EQ(text.find("mesh"), std::string::npos);
}

TEST(HarmonicsFile, TakesForeignKeysAndNeedsOnlyItsOwn) {
    const HarmonicsFile file = parse_harmonics(with("{", R"({"author": [1, {}], )"), "a.json");
    EXPECT_EQ(file.coefficients, std::vector<double>{3.5});
    EXPECT_EQ(file.center, (Vec3{0, 1, 2}));
    EXPECT_TRUE(file.mesh.empty());
    EXPECT_FALSE(file.rms_error);
}

TEST(HarmonicsFile, NamesWhatIsWrong) {
    expect_refusal("", {"not JSON", "not a surface by spherical harmonics"});
    expect_refusal("{\n\"format\": \n,", {"a.json:3: not JSON"});
    expect_refusal("[1]", {"not a surface by spherical harmonics", "stilb-harmonics"});
    expect_refusal(with("stilb-harmonics", "other"), {"not a surface by spherical harmonics"});
    expect_refusal(with("\"version\": 1, ", ""), {"\"version\" is missing"});
    expect_refusal(with("\"version\": 1", "\"version\": 2"), {"version 2", "reads version 1"});
    expect_refusal(with("\"degree\": 0", "\"degree\": 0.5"),
                   {"\"degree\"", "0.5", "whole number from 0 to 128"});
    expect_refusal(with("\"degree\": 0", "\"degree\": 129"), {"\"degree\" is 129", "0 to 128"});
    expect_refusal(with("\"degree\": 0", "\"degree\": -1"), {"\"degree\" is -1"});
    expect_refusal(with("\"degree\": 0", "\"degree\": 18446744073709551616"), {"\"degree\""});
    expect_refusal(with("\"degree\": 0", "\"degree\": 18446744073709551615"), {"\"degree\""});
    expect_refusal(with("\"degree\": 0", "\"degree\": 4294967296"), {"\"degree\""});
    expect_refusal(with("\"degree\": 0", "\"degree\": 1"),
                   {"a list of 1", "list of 4 numbers", "l^2 + l + m"});
    expect_refusal(with("[0, 1, 2]", "[0, 1]"), {"\"center\" is a list of 2", "x, y and z"});
    expect_refusal(with("[0, 1, 2]", "7"), {"\"center\" is number"});
    expect_refusal(with("[0, 1, 2]", "[0, \"1\", 2]"), {"center[1]"});
    expect_refusal(with("[3.5]", "[null]"), {"coefficients[0] is \"null\""});
    expect_refusal(with("[3.5]", "[1e39]"), {"coefficients[0]", "single precision"});
    expect_refusal(with("[3.5]", "[1e999]"), {"too large"});
    expect_refusal(with("[3.5]", "[NaN]"), {"not JSON"});
}

TEST(HarmonicsFile, OfDiskNamesThePath) {
    const TestFolder folder;
    const auto path = folder / "ball.json";
    write_harmonics(sample(3), path);
    EXPECT_EQ(read_harmonics(path).coefficients.size(), 16u);
    std::filesystem::remove(path);
    try {
        read_harmonics(path);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
}

}  // namespace
}  // namespace stilb::io
