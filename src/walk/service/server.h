// The page and its data over HTTP, for browsers on this machine only. docs/walk.md ("Safety") states who may
// read what.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "walk/page.h"

namespace stilb::walk {

/// Bytes that stay while they are sent, however slowly.
using Bytes = std::shared_ptr<const std::string>;

/// The answers to requests. All functions are called from several threads at the same time.
struct Handlers {
    PageFiles page;
    std::function<Bytes()> scene, light;  ///< compressed by gzip; null: not there yet
    std::function<std::string()> state;   ///< a JSON document
    /// JSON to JSON. Where the request is wrong they throw InputError, where it cannot be met now Cancelled.
    std::function<std::string(std::string_view)> measure, sensors;
};

struct ServerLimits {
    std::size_t body_bytes = std::size_t{64} * 1024;
    std::size_t header_bytes = std::size_t{32} * 1024;
    std::size_t connections = 64;               ///< for one more, the oldest one that waits is closed
    std::chrono::milliseconds request{4000};    ///< for a request to arrive completely, from its first byte
    std::chrono::milliseconds idle{5000};       ///< between requests
    std::chrono::milliseconds response{60000};  ///< for a response to be taken
};

/// A server on 127.0.0.1, with threads of its own. Every path begins with a random token.
class Server {
  public:
    /// `port` 0: any that is free. Throws InputError where the port cannot be taken.
    Server(Handlers handlers, int port, const ServerLimits& limits = {});
    /// Ends within a fraction of a second, unless a handler takes longer.
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    int port() const;
    /// The address of the page: http://127.0.0.1:PORT/TOKEN/
    std::string address() const;

  private:
    class Http;
    std::unique_ptr<Http> http_;
};

/// Whether both texts are equal, in a time that does not depend on where they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// 128 random bits of the system's generator, as 32 hexadecimal digits.
std::string random_token();

}  // namespace stilb::walk
