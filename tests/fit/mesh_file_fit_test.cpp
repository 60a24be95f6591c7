// Fits of real meshes.
#include <gtest/gtest.h>

#include <string>

#include "fit/mesh_fit.h"
#include "io/mesh_checks.h"

namespace stilb::fit {
namespace {

class RealMeshFit : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(io::shared_mesh("igea.ply")))
            GTEST_SKIP() << "../shared/data/meshes is absent";
    }
    static MeshFit fit(const std::string& name, const MeshFitOptions& options) {
        return fit_mesh(io::read_mesh_file(io::shared_mesh(name)).mesh, options, name);
    }
    static std::string refusal(const std::string& name) {
        try {
            fit(name, {.degree = 8});
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }
};

/// A head: folds at nose and ears are far below the tolerance.
TEST_F(RealMeshFit, OfAHeadIsGood) {
    const MeshFit head = fit("igea.ply", {.degree = 32});
    EXPECT_LT(head.survey.folded_share, 0.0005);
    EXPECT_GT(head.survey.folded_share, 0);
    EXPECT_EQ(head.survey.missed_share, 0);
    EXPECT_LT(*head.margin, 0);
    EXPECT_LT(head.errors[32].rms, 0.003 * head.size);
    for (const std::size_t degree : {4, 8, 16})
        EXPECT_LT(head.errors[2 * degree].rms, 0.65 * head.errors[degree].rms);
}

TEST_F(RealMeshFit, IsRefusedWhereTheMeshIsNotStarShaped) {
    for (const char* name : {"suzanne.obj", "stanford-bunny.obj", "beetle.obj", "spot.obj"}) {
        const std::string message = refusal(name);
        EXPECT_TRUE(message.starts_with(std::string(name) + ": not star-shaped")) << message;
        EXPECT_NE(message.find("theta"), std::string::npos);
        EXPECT_NE(message.find("force"), std::string::npos);
    }
    EXPECT_NE(refusal("beetle.obj").find("no surface"), std::string::npos);
}

TEST_F(RealMeshFit, TakesTheOutermostSurfaceOnRequest) {
    const MeshFit monkey = fit("suzanne.obj", {.degree = 32, .otherwise = NotStarShaped::take_outermost});
    EXPECT_NEAR(monkey.survey.folded_share, 0.055, 0.02);
    EXPECT_LT(monkey.errors[32].rms, 0.015 * monkey.size);
    const MeshFit rabbit =
        fit("stanford-bunny.obj", {.degree = 16, .otherwise = NotStarShaped::take_outermost});
    EXPECT_GT(rabbit.survey.missed_share, 0.005);  // the holes in its bottom
    EXPECT_LT(rabbit.errors[16].rms, 0.04 * rabbit.size);
}

}  // namespace
}  // namespace stilb::fit
