#include "io/import/textures/texture_pieces.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "base/parallel.h"
#include "patches/refinement.h"

namespace stilb::io {
namespace {

/// The longest edge of a piece of about a texel: half of one has a diagonal of 1.41.
constexpr double kTexelPiece = 1.5;
/// Few pieces are divided further, so that the edges of coarse patterns become sharp.
constexpr double kFinestPiece = 0.25;
constexpr std::size_t kShareOfFinest = 10;

std::array<double, 3> weights_of(const Mesh& mesh, std::uint32_t triangle, std::uint32_t vertex,
                                 const Vec3& position) {
    std::array<double, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (mesh.triangles[triangle][i] != vertex) continue;
        weights[i] = 1;  // without rounding
        return weights;
    }
    const Vec3 barycentric = geometry::barycentric_of(mesh, triangle, position);
    return {barycentric.x, barycentric.y, barycentric.z};
}

/// A difference that is seen: 0.2 % of light and 2 % of the mean.
bool varies(const Piece& piece) { return piece.deviation > 0.002 + 0.02 * piece.colour.max(); }

/// Means over a piece, from points of it.
class PieceSample {
  public:
    PieceSample(const MaskedTexture& texture, const FacePlace& place) : texture_(texture), place_(place) {
        const double width = texture.map.picture->width, height = texture.map.picture->height;
        for (std::size_t i = 0; i < 3; ++i) {
            const Uv &from = place[i], &to = place[(i + 1) % 3];
            longest_texels_ =
                std::max(longest_texels_, std::hypot((to[0] - from[0]) * width, (to[1] - from[1]) * height));
        }
        const double doubled = (place[1][0] - place[0][0]) * (place[2][1] - place[0][1]) -
                               (place[2][0] - place[0][0]) * (place[1][1] - place[0][1]);
        texels_ = std::abs(doubled) / 2 * width * height;
    }

    /// `most`: of the points that are looked up.
    void apply_to(Piece& piece, double most) const {
        constexpr double fewest = 64, per_texel = 4;
        const auto count = static_cast<std::size_t>(std::clamp(per_texel * texels_, fewest, most));
        Rgb sum, squares;
        std::size_t filled = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& texel = texture_.map.at(uv_at(place_, even_point_of_triangle(i)));
            if (texture_.is_hole(texel)) continue;
            const Rgb colour = texture_.shows_colours ? linear_rgb(texel) : Rgb{};
            sum += colour;
            squares += colour * colour;
            ++filled;
        }
        piece.longest_texels = longest_texels_;
        piece.filled = static_cast<double>(filled) / static_cast<double>(count);
        double variance = piece.filled * (1 - piece.filled);
        if (filled > 0) {
            const double each = 1 / static_cast<double>(filled);
            piece.colour = each * sum;
            variance = std::max(variance, (each * squares + -1 * (piece.colour * piece.colour)).max());
        }
        piece.deviation = std::sqrt(variance);
    }

  private:
    const MaskedTexture& texture_;
    const FacePlace& place_;
    double longest_texels_ = 0, texels_ = 0;
};

class PieceDivision {
  public:
    PieceDivision(const TexturedMesh& mesh, std::span<const MaskedTexture> textures, std::size_t most)
        : mesh_(mesh), textures_(textures), most_(most), refined_(patches::unrefined(mesh.mesh)) {
        take_pieces(0);
    }

    TexturePieces run() && {
        while (divide_once()) continue;
        TexturePieces result{std::move(refined_.mesh.vertices), {}, {}};
        result.coarsest_m.resize(textures_.size());
        for (const Piece& piece : pieces_) {
            const std::uint32_t texture = texture_of(piece);
            if (texture == kNoTexture || piece.longest_texels <= kTexelPiece || !varies(piece)) continue;
            double& longest_m = result.coarsest_m[texture];
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 &a = result.vertices[piece.corners[i]],
                           &b = result.vertices[piece.corners[(i + 1) % 3]];
                longest_m = std::max(longest_m, length(b - a));
            }
        }
        result.pieces = std::move(pieces_);
        return result;
    }

  private:
    std::uint32_t texture_of(const Piece& piece) const { return mesh_.textures[piece.parent]; }

    /// The pieces of the refined mesh: those that are new have a vertex of the number `first_new` or more.
    void take_pieces(std::size_t first_new) {
        std::vector<Piece> all;
        all.reserve(refined_.parents.size());
        std::vector<std::size_t> fresh;
        auto known = pieces_.begin();
        for (std::size_t i = 0; i < refined_.parents.size(); ++i) {
            const Triangle& corners = refined_.mesh.triangles[i];
            if (std::ranges::max(corners) >= first_new) {
                fresh.push_back(i);
                all.push_back({corners, refined_.parents[i]});
                continue;
            }
            while (known->corners != corners) ++known;  // those between have been divided
            all.push_back(*known++);
        }
        pieces_ = std::move(all);
        count_pieces();
        constexpr std::size_t at_a_time = 64;
        parallel_for_parts(
            fresh.size(),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) look_up(pieces_[fresh[i]]);
            },
            at_a_time);
    }

    void count_pieces() {
        counts_.assign(textures_.size(), 0);
        for (const Piece& piece : pieces_) {
            if (texture_of(piece) != kNoTexture) ++counts_[texture_of(piece)];
        }
    }

    void look_up(Piece& piece) const {
        const std::vector<Vec3>& vertices = refined_.mesh.vertices;
        const auto& [a, b, c] = piece.corners;
        piece.area_m2 = geometry::triangle_area_m2(vertices[a], vertices[b], vertices[c]);
        const std::uint32_t texture = texture_of(piece);
        if (texture == kNoTexture) return;
        FacePlace place{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = piece.corners[i];
            place[i] = uv_at(mesh_.places[piece.parent],
                             weights_of(mesh_.mesh, piece.parent, vertex, vertices[vertex]));
        }
        // Few large pieces can have many points, which find small details.
        constexpr double in_all = 262144, most = 256;
        const double share = in_all / static_cast<double>(counts_[texture]);
        PieceSample(textures_[texture], place).apply_to(piece, std::max(most, share));
    }

    bool divide_once() {
        std::unordered_set<std::uint64_t> marked;
        std::vector<std::vector<const Piece*>> coarse(textures_.size()), fine(textures_.size());
        for (const Piece& piece : pieces_) {
            if (texture_of(piece) == kNoTexture || !varies(piece)) continue;
            if (piece.longest_texels > kTexelPiece)
                coarse[texture_of(piece)].push_back(&piece);
            else if (piece.longest_texels > kFinestPiece)
                fine[texture_of(piece)].push_back(&piece);
        }
        for (std::size_t t = 0; t < textures_.size(); ++t) {
            mark(coarse[t], most_, counts_[t], marked);
            if (coarse[t].empty()) mark(fine[t], most_ / kShareOfFinest, counts_[t], marked);
        }
        if (marked.empty()) return false;
        const std::size_t first_new = refined_.mesh.vertices.size();
        patches::halve_edges(
            refined_,
            [&](const patches::Edge& edge) { return marked.contains(patches::edge_key(edge.a, edge.b)); },
            [](const Vec3& a, const Vec3& b) { return 0.5 * (a + b); });
        take_pieces(first_new);
        return true;
    }

    /// Marks the longest edges of the pieces whose division gains most, as many as there is room for.
    void mark(std::vector<const Piece*>& pieces, std::size_t most, std::size_t count,
              std::unordered_set<std::uint64_t>& marked) const {
        constexpr std::size_t nearly_full = 20;  // the last twentieth would take many steps
        const std::size_t room = most > count ? most - count : 0;
        if (room <= most / nearly_full) return;
        const std::size_t taken = std::min(pieces.size(), room / 2 + 1);  // neighbours are divided, too
        const auto gain = [](const Piece* piece) {
            return piece->area_m2 * piece->deviation * piece->deviation;
        };
        std::ranges::nth_element(pieces, pieces.begin() + static_cast<std::ptrdiff_t>(taken),
                                 std::ranges::greater{}, gain);
        for (const Piece* const piece : std::span(pieces).first(taken)) marked.insert(longest_edge(*piece));
    }

    std::uint64_t longest_edge(const Piece& piece) const {
        const std::vector<Vec3>& vertices = refined_.mesh.vertices;
        std::uint64_t longest = 0;
        double most = -1;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = piece.corners[i], b = piece.corners[(i + 1) % 3];
            const double squared = squared_length(vertices[b] - vertices[a]);
            if (squared <= most) continue;
            most = squared;
            longest = patches::edge_key(a, b);
        }
        return longest;
    }

    const TexturedMesh& mesh_;
    std::span<const MaskedTexture> textures_;
    std::size_t most_;
    patches::RefinedMesh refined_;
    std::vector<Piece> pieces_;
    std::vector<std::size_t> counts_;  ///< of pieces, per texture
};

}  // namespace

TexturePieces divide_by_texture(const TexturedMesh& mesh, std::span<const MaskedTexture> textures,
                                std::size_t most) {
    return PieceDivision(mesh, textures, most).run();
}

std::array<double, 3> place_in_parent(const TexturedMesh& mesh, const TexturePieces& all, const Piece& piece,
                                      std::size_t corner) {
    const std::uint32_t vertex = piece.corners[corner];
    return weights_of(mesh.mesh, piece.parent, vertex, all.vertices[vertex]);
}

}  // namespace stilb::io
