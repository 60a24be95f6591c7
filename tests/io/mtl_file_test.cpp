// Materials of MTL files.
#include "io/import/obj/mtl_file.h"

#include <gtest/gtest.h>

namespace stilb::io {
namespace {

MtlMaterial one(const std::string& statements) {
    const MtlLibrary library = read_mtl("newmtl m\n" + statements);
    EXPECT_EQ(library.materials.size(), 1u);
    EXPECT_TRUE(library.remarks.empty());
    return library.materials.at(0);
}

using Remarks = std::vector<std::string>;

TEST(MtlFile, StatementsBeforeTheFirstMaterialAreLeftOut) {
    const MtlLibrary library = read_mtl("Ns 10\nnewmtl m\nKd 0.3 0.3 0.3\n");
    ASSERT_EQ(library.materials.size(), 1u);
    EXPECT_EQ(library.materials[0].diffuse, Rgb::grey(0.3));
    EXPECT_EQ(library.remarks, Remarks{"line 1: \"Ns\" stands before the first newmtl; it is left out."});
}

TEST(MtlFile, NumbersOutsideTheirRangeAreItsEnds) {
    const auto opacity = [](const std::string& d) { return one("d " + d + "\n").opacity; };
    EXPECT_EQ(opacity("-0.1"), 0);
    EXPECT_EQ(opacity("0.4"), 0.4);
    EXPECT_EQ(opacity("1"), 1);
    EXPECT_EQ(opacity("1.5"), 1);
    EXPECT_EQ(one("Kd -1 0.5 2\n").diffuse, (Rgb{{0, 0.5, 2}}));
    EXPECT_EQ(one("Ns -1\n").exponent, 0);
    EXPECT_EQ(one("Ns -1\n").remarks,
              Remarks{"Ns is \"-1\". Allowed: a number from 0 to 1000000000000000; 0 is used."});
    EXPECT_TRUE(one("Ns 10\nd 1\nPr 1\n").remarks.empty());
}

TEST(MtlFile, WhatIsNoNumberIsLeftOut) {
    EXPECT_EQ(one("Kd 0.5 nan 0.5\n").diffuse, Rgb::grey(0.8));
    EXPECT_EQ(one("Kd spectral a.rfl\n").diffuse, Rgb::grey(0.8));
    EXPECT_EQ(one("Ns\n").exponent, 0);
    EXPECT_EQ(one("illum two\n").illum, std::nullopt);
    EXPECT_EQ(one("illum two\n").remarks.size(), 1u);
}

TEST(MtlFile, TrAloneIsTransparency) {
    EXPECT_NEAR(one("Tr 0\n").opacity, 1, 1e-12);
    EXPECT_NEAR(one("Tr 0.3\n").opacity, 0.7, 1e-12);
    EXPECT_NEAR(one("Tr 0.999\n").opacity, 0.001, 1e-12);
    EXPECT_TRUE(one("Tr 0.3\n").remarks.empty());
}

/// As MeshLab writes it, for all materials.
TEST(MtlFile, TrOfOneAloneMeansOpacity) {
    EXPECT_EQ(one("Tr 1\n").opacity, 1);
    EXPECT_EQ(one("Tr 1\n").remarks.size(), 1u);
    const MtlLibrary library = read_mtl("newmtl a\nTr 0.3\nnewmtl b\nTr 1.0\nnewmtl c\nd 0.5\n");
    EXPECT_EQ(library.materials.at(0).opacity, 0.3);
    EXPECT_EQ(library.materials.at(1).opacity, 1);
    EXPECT_EQ(library.materials.at(2).opacity, 0.5);
}

TEST(MtlFile, ContradictionsOfDAndTrAreNamed) {
    EXPECT_EQ(one("d 0.4\nTr 0.6\n").opacity, 0.4);
    EXPECT_TRUE(one("d 0.4\nTr 0.6\n").remarks.empty());
    for (const std::string statements : {"d 1\nTr 1\n", "Tr 1\nd 1\n", "d 0\nTr 0\n"}) {
        const MtlMaterial material = one(statements);
        EXPECT_EQ(material.opacity, 1) << statements;
        ASSERT_EQ(material.remarks.size(), 1u) << statements;
        EXPECT_NE(material.remarks[0].find("contradict each other; d 1 is used."), std::string::npos);
    }
    EXPECT_EQ(one("d 0.3\nTr 0.3\n").opacity, 0.3);
}

TEST(MtlFile, OptionsOfPicturesAreNoNames) {
    EXPECT_EQ(one("map_Kd -colorspace sRGB t.png\n").diffuse_map.file, "t.png");
    EXPECT_EQ(one("map_Kd -type sphere -mm 0 1 a b.png\n").diffuse_map.file, "a b.png");
    EXPECT_EQ(one("map_d -imfchan m t.png\n").opacity_map.file, "t.png");
    EXPECT_EQ(one("map_Kd -s 2 2 1 -o 1 0 t.png\n").diffuse_map.scale, (std::array{2.0, 2.0}));
}

/// As Maya writes it.
TEST(MtlFile, APictureCountsAloneBesideKdOfZero) {
    const MtlMaterial beside_zero = one("Kd 0.00 0.00 0.00\nmap_Kd wood.bmp\n");
    EXPECT_EQ(beside_zero.diffuse, Rgb::grey(1));
    EXPECT_EQ(beside_zero.remarks, Remarks{"Kd 0 would make its map_Kd black; the picture alone counts."});
    EXPECT_EQ(one("Kd 0 0 0.01\nmap_Kd wood.bmp\n").diffuse, (Rgb{{0, 0, 0.01}}));
    EXPECT_EQ(one("Kd 0 0 0\nmap_Ks wood.bmp\n").diffuse, Rgb());
}

TEST(MtlFile, NamesInLatin1BecomeUtf8) {
    EXPECT_EQ(read_mtl("newmtl K\xfc"
                       "che\n")
                  .materials.at(0)
                  .name,
              "K\xc3\xbc"
              "che");
}

}  // namespace
}  // namespace stilb::io
