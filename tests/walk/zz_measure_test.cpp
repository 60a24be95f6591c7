#include <gtest/gtest.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include "io/scene/scene_file.h"
#include "walk/container_reader.h"
#include "walk/walk_rooms.h"
namespace stilb::walk { namespace {
TEST(Measure, Scene) {
  const char* f = std::getenv("WALK_SCENE"); if(!f) GTEST_SKIP();
  auto file = io::read_scene_file(f);
  auto t0 = std::chrono::steady_clock::now();
  auto el=[&]{ return std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count(); };
  rays::RayCaster caster(file.scene);
  double n = std::getenv("WALK_PATCHES") ? atof(std::getenv("WALK_PATCHES")) : 10000;
  estimators::PatchSolution s; s.patches = patches::make_patches(file.scene, patches::patch_size_m(file.scene, n));
  s.degree=6; s.groups = scene::light_groups(file.scene).names;
  std::printf("patches %zu vertices %zu %.2fs\n", s.patches.count(), s.patches.vertices.size(), el());
  std::vector<bool> dark(2*s.patches.count());
  auto t1=el();
  auto mesh = make_display_mesh(file.scene, caster, s.patches, dark);
  std::printf("mesh %zu vertices %zu triangles %zu parts %.2fs\n", mesh.vertices.size(), mesh.triangles.size(), mesh.parts.size(), el()-t1);
  t1=el();
  WalkScene w{file.scene.name, "x.toml", file.sensors};
  auto bytes = scene_data(file.scene, caster, s, w);
  std::printf("scene_data %.2fs, %zu bytes, raw %zu\n", el()-t1, bytes.size(), gunzipped(bytes).size());
  ContainerReader r(gunzipped(bytes));
  std::printf("%s\n", r.header["meshes"].dump().substr(0,600).c_str());
  for (auto& [k,v]: r.header["arrays"].items()) std::printf("%s %s\n", k.c_str(), v.dump().c_str());
}
}}
