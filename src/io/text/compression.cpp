#include "io/text/compression.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace stilb::io {
namespace {

constexpr int kGzip = 16 + MAX_WBITS;

/// The next bytes, as many as zlib takes at once.
void feed(z_stream& stream, std::string_view& bytes) {
    const std::size_t part = std::min<std::size_t>(bytes.size(), std::numeric_limits<int>::max());
    // zlib reads only, but its interface is older than const.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(part);
    bytes.remove_prefix(part);
}

}  // namespace

std::string gzip(std::string_view bytes, Compression compression) {
    constexpr int kMemory = 8;
    const int level = compression == Compression::fast ? Z_BEST_SPEED : Z_DEFAULT_COMPRESSION;
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib: no memory");
    std::string compressed;
    std::vector<char> buffer(1 << 16);
    int status = Z_OK;
    while (status == Z_OK) {
        if (stream.avail_in == 0) feed(stream, bytes);
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        status = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
        compressed.append(buffer.data(), buffer.size() - stream.avail_out);
    }
    deflateEnd(&stream);
    if (status != Z_STREAM_END) throw std::runtime_error("zlib: the data could not be compressed");
    return compressed;
}

std::optional<std::string> gunzip(std::string_view compressed, std::size_t size) {
    z_stream stream{};
    if (inflateInit2(&stream, kGzip) != Z_OK) throw std::runtime_error("zlib: no memory");
    std::string bytes;
    std::vector<char> buffer(1 << 16);
    int status = Z_OK;
    while (status == Z_OK && bytes.size() <= size) {
        if (stream.avail_in == 0) feed(stream, compressed);
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        status = inflate(&stream, Z_NO_FLUSH);
        bytes.append(buffer.data(), buffer.size() - stream.avail_out);
    }
    const bool is_whole = status == Z_STREAM_END && stream.avail_in == 0 && compressed.empty();
    inflateEnd(&stream);
    if (!is_whole || bytes.size() != size) return std::nullopt;
    return bytes;
}

}  // namespace stilb::io
