// Depth peeling [Everitt 2001, Interactive order-independent transparency]: a layer is the nearest of all
// surfaces behind the layer before, pixel by pixel. Behind means farther or, at the same depth, of a higher
// number: so two patches at the same position both get their layer. Depth is the share of the grid's depth,
// in single precision; the same patch has exactly the same depth in every layer.
//
// Agreement with rays is that of item buffers (opengl_item_buffers.cpp): a line that is nearer than 1/256 of
// the spacing to an edge may fall to the other side of it.
#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <mutex>
#include <vector>

#include "patches/visibility/bundle.h"
#include "patches/visibility/opengl.h"

namespace stilb::patches {
namespace {

/// `axes` are the bundle's u, v and w, `corner` is that of the picture; `scale` maps the picture to [0, 1]^3.
constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform vec3 corner;
layout(location = 1) uniform vec3 axes[3];
layout(location = 4) uniform vec3 scale;
void main() {
    vec3 offset = position - corner;
    vec3 seen = scale * vec3(dot(axes[0], offset), dot(axes[1], offset), dot(axes[2], offset));
    gl_Position = vec4(2 * seen.xy - 1, seen.z, 1);
}
)";

/// A layer's pixels: the side, and the bits of its depth.
constexpr const char* kFragmentShader = R"(#version 450 core
layout(binding = 0) uniform usampler2D layer_before;
layout(location = 5) uniform uint count;
layout(location = 0) out uvec2 side_and_depth;
void main() {
    uint patch_number = uint(gl_PrimitiveID);
    uvec2 before = texelFetch(layer_before, ivec2(gl_FragCoord.xy), 0).xy;
    float depth = gl_FragCoord.z, depth_before = uintBitsToFloat(before.y);
    if (depth < depth_before || (depth == depth_before && patch_number <= before.x % count)) discard;
    side_and_depth = uvec2(patch_number + (gl_FrontFacing ? 0u : count), floatBitsToUint(depth));
}
)";

constexpr GLint kCorner = 0, kAxes = 1, kScale = 4, kCount = 5;

/// Larger grids are drawn in parts of at most so many lines along an edge: all layers of one part stay in
/// memory. Every OpenGL 4.5 has pictures of 16384.
constexpr int kLargestTile = 2048;

struct LayerPixel {
    GLuint side, depth_bits;
};
constexpr LayerPixel kNothing{kNoSide, std::bit_cast<GLuint>(std::numeric_limits<float>::infinity())};
constexpr LayerPixel kBeforeAll{0, std::bit_cast<GLuint>(-1.0F)};

/// Pixels row by row.
using Layer = std::vector<LayerPixel>;

/// A part of the grid.
struct Tile {
    int x = 0, y = 0, width = 0, height = 0;

    std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

std::vector<Tile> tiles_of(const LineGrid& grid) {
    std::vector<Tile> tiles;
    for (int y = 0; y < grid.height; y += kLargestTile) {
        for (int x = 0; x < grid.width; x += kLargestTile) {
            tiles.push_back(
                {x, y, std::min(kLargestTile, grid.width - x), std::min(kLargestTile, grid.height - y)});
        }
    }
    return tiles;
}

/// The crossings of one line, from its pixel in all layers.
void collect(const std::vector<Layer>& layers, std::size_t pixel, double depth_m,
             std::vector<Crossing>& crossings) {
    crossings.clear();
    for (const Layer& layer : layers) {
        const auto [side, depth_bits] = layer[pixel];
        if (side == kNoSide) return;
        crossings.push_back({static_cast<float>(depth_m) * std::bit_cast<float>(depth_bits), side});
    }
}

}  // namespace

struct OpenGlBundles::Implementation {
    OpenGlPatches drawing;
    Bounds bounds;
    std::mutex in_use;
    std::array<GLuint, 2> frame_buffers{}, layers{};  ///< drawn to by turns
    GLuint depth = 0;
    int picture_width = 0, picture_height = 0;

    explicit Implementation(const Patches& patches)
        : drawing(patches, {kVertexShader, kFragmentShader}), bounds(bounds_of(patches)) {
        const OpenGlContext::Current current(drawing.context());
        glUniform1ui(kCount, static_cast<GLuint>(patches.count()));
        glGenFramebuffers(2, frame_buffers.data());
        glFrontFace(GL_CW);  // seen along w, with u to the right and v upwards: mirrored
        check_opengl();
    }

    /// For tiles of that size or smaller.
    void provide_pictures(int width, int height) {
        if (width <= picture_width && height <= picture_height) return;
        picture_width = std::max(width, picture_width), picture_height = std::max(height, picture_height);
        glDeleteTextures(2, layers.data());
        glDeleteRenderbuffers(1, &depth);
        glGenTextures(2, layers.data());
        glGenRenderbuffers(1, &depth);
        glBindRenderbuffer(GL_RENDERBUFFER, depth);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, picture_width, picture_height);
        for (std::size_t i = 0; i < 2; ++i) {
            glBindTexture(GL_TEXTURE_2D, layers[i]);
            glTexStorage2D(GL_TEXTURE_2D, 1, GL_RG32UI, picture_width, picture_height);
            // Integers cannot be filtered: without this they are not read at all.
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
            glBindFramebuffer(GL_FRAMEBUFFER, frame_buffers[i]);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, layers[i], 0);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
        }
        check_opengl();
    }

    void clear_layer(std::size_t target, const LayerPixel& pixel) const {
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffers[target]);
        const std::array<GLuint, 4> colour{pixel.side, pixel.depth_bits, 0, 0};
        glClearBufferuiv(GL_COLOR, 0, colour.data());
    }

    void set_view(const LineGrid& grid, const Frame& frame, const Tile& tile) const {
        const double width_m = tile.width * length(grid.step_x), height_m = tile.height * length(grid.step_y);
        const Vec3 to_corner = -0.5 * (grid.step_x + grid.step_y);  // from the middle of a pixel
        set_uniform(kCorner, {grid.origin(tile.x, tile.y) + to_corner});
        set_uniform(kAxes, {frame.u, frame.v, frame.w});
        set_uniform(kScale, {{1 / width_m, 1 / height_m, 1 / grid.depth_m}});
        glViewport(0, 0, tile.width, tile.height);
    }

    /// The last layer is the last one with any crossing.
    std::vector<Layer> peeled(const Tile& tile) const {
        std::vector<Layer> all;
        clear_layer(1, kBeforeAll);
        for (;;) {
            const std::size_t target = all.size() % 2;
            clear_layer(target, kNothing);
            glClear(GL_DEPTH_BUFFER_BIT);
            glBindTexture(GL_TEXTURE_2D, layers[1 - target]);
            drawing.draw();
            Layer layer(tile.size());
            glReadPixels(0, 0, tile.width, tile.height, GL_RG_INTEGER, GL_UNSIGNED_INT, layer.data());
            check_opengl();
            const auto is_empty = [](const LayerPixel& pixel) { return pixel.side == kNoSide; };
            if (std::ranges::all_of(layer, is_empty)) return all;
            all.push_back(std::move(layer));
        }
    }

    std::vector<Layer> draw(const LineGrid& grid, const Frame& frame, const Tile& tile) {
        const std::scoped_lock alone(in_use);
        const OpenGlContext::Current current(drawing.context());
        provide_pictures(tile.width, tile.height);
        set_view(grid, frame, tile);
        return peeled(tile);
    }
};

OpenGlBundles::OpenGlBundles(const Patches& patches)
    : implementation_(std::make_unique<Implementation>(patches)) {}
OpenGlBundles::~OpenGlBundles() = default;

const std::string& OpenGlBundles::renderer() const { return implementation_->drawing.renderer(); }

void OpenGlBundles::cast(const Bundle& bundle, const LineVisitor& visit) const {
    const OpenGlPatches& drawing = implementation_->drawing;
    const LineGrid grid(implementation_->bounds, bundle);
    const CoincidentCrossings coincident(drawing.patches(), bundle.frame.w);
    const double half_extent_m = implementation_->bounds.half_extent();
    std::vector<Crossing> crossings;
    CrossedLines row;
    for (const Tile& tile : tiles_of(grid)) {
        const std::vector<Layer> layers = implementation_->draw(grid, bundle.frame, tile);
        std::size_t pixel = 0;
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            row.start(grid.line_area_m2);
            for (int x = tile.x; x < tile.x + tile.width; ++x, ++pixel) {
                collect(layers, pixel, grid.depth_m, crossings);
                coincident.remove_from(crossings, half_extent_m);
                row.add(drawing.patches().center + grid.origin(x, y), crossings);
            }
            if (row.count() > 0) visit(row);
        }
    }
}

}  // namespace stilb::patches
