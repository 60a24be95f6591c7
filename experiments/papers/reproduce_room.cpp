// Figure 5 of [LocalEstimation]: a picture of a simple room.
//
// By `auto`, which is local estimation where that is good: by itself, as in the paper, it speckles the
// surfaces next to corners (docs/methods/local.md).
#include "base/version.h"
#include "cli/progress.h"
#include "io/image/picture.h"
#include "io/image/picture_file.h"
#include "io/scene/scene_file.h"
#include "papers/paper_room.h"
#include "papers/reproduce.h"
#include "run/run.h"

namespace stilb::papers {

void reproduce_room(const std::filesystem::path& directory) {
    io::PictureOrigin origin;
    origin.scene = "scenes/paper/room.toml";
    origin.command = "stilb reproduce room";
    origin.version = program_version();
    const io::SceneFile file = io::read_scene(kPaperRoom, origin.scene, {});
    const Sensor& view = file.sensors.front();
    origin.sensor = view.name;
    origin.method = file.run.method;
    origin.seed = file.run.seed;
    cli::TerminalProgress progress("passes");
    const io::Picture picture =
        io::picture_of(render(file.scene, view, file.run, &progress), *view.camera(), origin);
    for (const char* name : {"room.exr", "room.png"}) write_picture(picture, directory / name);
}

}  // namespace stilb::papers
