// What tests of runs that another run continues or repeats have in common.
#pragma once

#include <atomic>
#include <string>

#include "base/bytes.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {

/// A room with a lamp below its ceiling and a box.
inline Scene room_with_box() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    add_object(scene, Box{{1.7, 0.6, 0.001}, {2.5, 1.4, 0.7}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(5000));
    return scene;
}

/// `State`: of readings or of a picture.
template <typename State>
std::string bytes_of(const State& state) {
    ByteWriter bytes;
    state.write(bytes);
    return bytes.take();
}
template <typename State>
State read_state(const std::string& bytes) {
    const std::string name = "run";
    ByteReader reader(bytes, 0, name, "Run again.");
    State state = State::read(reader);
    reader.expect_end();
    return state;
}

/// Interrupts after so many reports.
class Impatience final : public PictureSink {
  public:
    explicit Impatience(int reports) : left_(reports) {}
    void report(const Progress&) override { interrupt = --left_ <= 0; }
    bool wants_picture() override { return false; }
    void show(const Pixels&) override {}
    std::atomic<bool> interrupt = false;

  private:
    int left_;
};

}  // namespace stilb::run
