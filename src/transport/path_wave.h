// Paths traced side by side, in packets of sixteen: the loop of PathTracer::trace().
//
// A round takes every path from one vertex to the next: the light of a source, a reflection, and the ray to
// the next vertex. Vertices on plain diffuse surfaces are computed sixteen at a time in single precision
// (path_packet.h); all others one by one, by PathTracer::take_step(). Paths that end make room for the last
// ones, so that packets stay full.
#pragma once

#include <span>
#include <vector>

#include "transport/path_packet.h"
#include "transport/path_tracer.h"

namespace stilb::transport {

class PathWave {
  public:
    /// Adds the light of path number n to luminances_cd_m2[n].
    PathWave(const PathTracer& tracer, unsigned sobol_dimensions, std::span<Rgb> luminances_cd_m2)
        : tracer_(tracer), sobol_dimensions_(sobol_dimensions), luminances_cd_m2_(luminances_cd_m2) {}

    /// Paths of which the first rays are known, in the lanes that are set. Uses the packets up.
    void trace_from_rays(std::span<PathPacket> packets, std::span<const LaneMask> lanes,
                         rays::Coherence coherence);
    /// Paths at their first vertices.
    void trace_from_hits(std::span<const Path> paths, rays::Coherence coherence);

  private:
    PathPacket& packet_of(std::size_t path) { return packets_[path / kPacketWidth]; }
    /// Of the paths of packet p; others are not set.
    LaneMask lanes_of(std::size_t p) const;
    std::size_t packets_in_use() const { return (count_ + kPacketWidth - 1) / kPacketWidth; }

    /// Follows all paths from their vertices to their ends.
    void follow(rays::Coherence coherence);
    void reflect(PathPacket& paths, LaneMask& lanes, rays::Coherence coherence);
    void reflect_plain(PathPacket& paths, LaneMask& lanes, ConnectionPacket& connections) const;
    void reflect_generally(PathPacket& paths, std::size_t lane, LaneMask& lanes,
                           ConnectionPacket& connections);
    void connect(const PathPacket& paths, ConnectionPacket& connections, rays::Coherence coherence);
    /// Traces the rays of all paths to their next vertices.
    void arrive(rays::Coherence coherence);
    void arrive(PathPacket& paths, LaneMask& lanes, rays::Coherence coherence);
    /// Adds light to the luminance of a path at its vertex.
    void add(const PathPacket& paths, std::size_t lane, const Rgb& luminance_cd_m2, std::size_t light);
    /// Prepares a vertex for reflect_generally().
    void make_general(PathPacket& paths, std::size_t lane, const rays::Hit& hit);
    void make_general(PathPacket& paths, std::size_t lane, const Path& path);
    PreviousVertex previous_vertex(const PathPacket& paths, std::size_t lane) const;
    /// All that a path takes to its next vertex but the ray.
    void set_state(PathPacket& paths, std::size_t lane, const Path& path) const;
    /// Removes the paths whose lanes are not set in `going`, one mask for each packet in use.
    void remove_ended(std::span<const LaneMask> going);

    const PathTracer& tracer_;
    unsigned sobol_dimensions_;
    std::span<Rgb> luminances_cd_m2_;
    std::span<PathPacket> packets_;
    std::span<const Path> asked_;  ///< the paths where parts are asked for; else empty
    std::size_t count_ = 0;        ///< of paths: those of the first lanes
    std::vector<Path> general_;    ///< vertices that are reflected one by one
    std::vector<LaneMask> going_;
    rays::RayHitPacket hits_;
};

}  // namespace stilb::transport
