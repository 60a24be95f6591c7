#include "walk/service/server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "stilb/error.h"

namespace stilb::walk {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kLoopback = "127.0.0.1";
/// The threads that answer requests. Most of them wait for the next request of a browser.
constexpr std::size_t kWorkers = 32;
/// How often a wait looks whether the server ends.
constexpr std::chrono::milliseconds kGlance{50};

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
    "'self'; "
    "worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Waits until the socket is ready for `event`, the deadline passes or the server ends.
bool wait_for(int socket, short event, Clock::time_point deadline, const std::atomic<bool>& is_ending) {
    while (!is_ending) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) return false;
        pollfd waiting{socket, event, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::min(left, kGlance).count()));
        if (ready > 0) return (waiting.revents & event) != 0;
        if (ready < 0 && errno != EINTR) return false;
    }
    return false;
}

/// A connection on which nothing takes longer, and no request is larger, than the limits say.
class Connection final : public httplib::Stream {
  public:
    Connection(int socket, const ServerLimits& limits, const std::atomic<bool>& is_ending)
        : socket_(socket), limits_(limits), is_ending_(is_ending) {}
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection() override { close(socket_); }

    /// Waits for the first byte of the next request.
    bool await_request() {
        if (begin_ == end_ && !wait_for(socket_, POLLIN, Clock::now() + limits_.idle, is_ending_))
            return false;
        deadline_ = Clock::now() + limits_.request;
        left_ = limits_.header_bytes + limits_.body_bytes;
        is_responding_ = false;
        return true;
    }

    bool is_readable() const override { return begin_ != end_ || is_ready(POLLIN); }
    bool is_writable() const override { return is_ready(POLLOUT); }

    ssize_t read(char* data, std::size_t size) override {
        if (begin_ == end_ && !fill()) return -1;
        const std::size_t count = std::min({size, end_ - begin_, left_});
        if (count == 0) return -1;
        std::copy_n(buffer_.data() + begin_, count, data);
        begin_ += count;
        left_ -= count;
        return static_cast<ssize_t>(count);
    }

    /// All of it, or -1.
    ssize_t write(const char* data, std::size_t size) override {
        if (!std::exchange(is_responding_, true)) deadline_ = Clock::now() + limits_.response;
        for (std::size_t done = 0; done < size;) {
            if (!is_ready(POLLOUT)) return -1;
            const ssize_t sent = send(socket_, data + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent < 0 && errno != EAGAIN && errno != EINTR) return -1;
            done += static_cast<std::size_t>(std::max<ssize_t>(sent, 0));
        }
        return static_cast<ssize_t>(size);
    }

    /// Ends the connection after a refusal: reads and forgets, for a short time, what the client still sends.
    /// With unread bytes left, close() would make the system discard the response.
    void end_gently() {
        shutdown(socket_, SHUT_WR);
        const auto deadline = Clock::now() + std::chrono::milliseconds(200);
        while (wait_for(socket_, POLLIN, deadline, is_ending_) &&
               recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT) > 0) {
        }
    }

    // The addresses interest nobody.
    void get_remote_ip_and_port(std::string&, int&) const override {}
    void get_local_ip_and_port(std::string&, int&) const override {}
    socket_t socket() const override { return socket_; }

  private:
    bool is_ready(short event) const { return wait_for(socket_, event, deadline_, is_ending_); }

    bool fill() {
        if (!is_ready(POLLIN)) return false;
        const ssize_t count = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
        begin_ = 0;
        end_ = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        return end_ > 0;
    }

    int socket_;
    const ServerLimits& limits_;
    const std::atomic<bool>& is_ending_;
    Clock::time_point deadline_;
    std::size_t left_ = 0;  ///< bytes that the present request may still have
    bool is_responding_ = false;
    std::array<char, 4096> buffer_;
    std::size_t begin_ = 0, end_ = 0;
};

/// The threads of a server. Connections beyond the limit are given to the calling thread, which accepts
/// connections; there they are closed.
class Workers final : public httplib::TaskQueue {
  public:
    explicit Workers(int most) : most_(most), pool_(kWorkers) {}
    void enqueue(std::function<void()> work) override {
        if (pending_ >= most_) return work();
        ++pending_;
        pool_.enqueue([this, work = std::move(work)] {
            work();
            --pending_;
        });
    }
    void shutdown() override { pool_.shutdown(); }

  private:
    int most_;
    std::atomic<int> pending_ = 0;
    httplib::ThreadPool pool_;
};

struct Refusal {
    int status = 0;
    std::string message;
};

void answer(httplib::Response& response, int status, std::string json) {
    response.status = status;
    response.set_content(std::move(json), "application/json");
}

void answer(httplib::Response& response, const Refusal& refusal) {
    answer(response, refusal.status,
           nlohmann::json{{"error", refusal.message}}.dump(-1, ' ', false,
                                                           nlohmann::json::error_handler_t::replace));
}

/// Sends bytes without a copy of them.
void answer(httplib::Response& response, Bytes bytes) {
    if (!bytes) return answer(response, {503, "This is not computed yet. Ask again."});
    response.status = 200;
    const std::size_t size = bytes->size();
    response.set_content_provider(
        size, "application/octet-stream",
        [bytes = std::move(bytes)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            constexpr std::size_t at_once = 1 << 18;
            return sink.write(bytes->data() + offset, std::min(length, at_once));
        });
}

void answer(httplib::Response& response, std::string_view text, const char* type) {
    response.status = 200;
    response.set_content(text.data(), text.size(), type);
}

/// Calls the handler of a POST request.
void answer_by(const std::function<std::string(std::string_view)>& handler, const std::string& body,
               httplib::Response& response) {
    try {
        answer(response, 200, handler(body));
    } catch (const InputError& error) {
        answer(response, {400, error.what()});
    } catch (const Cancelled& error) {
        answer(response, {503, error.what()});
    }
}

std::optional<std::size_t> length_of_body(const httplib::Request& request) {
    const std::string text = request.get_header_value("Content-Length");
    std::size_t length = 0;
    const char* const end = text.data() + text.size();
    const auto [stopped, failure] = std::from_chars(text.data(), end, length);
    if (text.empty() || failure == std::errc::invalid_argument || stopped != end) return std::nullopt;
    return failure == std::errc() ? length : std::numeric_limits<std::size_t>::max();
}

}  // namespace

bool equal_in_constant_time(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    // volatile: the compiler must not end the loop early.
    volatile unsigned char difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference = static_cast<unsigned char>(difference | static_cast<unsigned char>(a[i] ^ b[i]));
    return difference == 0;
}

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getentropy(bytes.data(), bytes.size()) != 0)
        throw std::runtime_error("the system's random numbers cannot be read, so there is no safe address");
    std::string token;
    for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
    return token;
}

class Server::Http final : private httplib::Server {
  public:
    Http(walk::Handlers handlers, int port, const ServerLimits& limits)
        : handlers_(std::move(handlers)), limits_(limits), token_(random_token()) {
        // Not SO_REUSEPORT, the library's choice: with it two servers share a port, and nobody notices.
        set_socket_options([](socket_t socket) {
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        bind(port);
        set_tcp_nodelay(true);
        set_keep_alive_max_count(1000);
        set_payload_max_length(limits_.body_bytes);
        new_task_queue = [this] { return new Workers(limits_.connections); };
        set_default_headers({{"Content-Security-Policy", kPolicy},
                             {"X-Content-Type-Options", "nosniff"},
                             {"Cache-Control", "no-store"},
                             {"Referrer-Policy", "no-referrer"},
                             {"Cross-Origin-Resource-Policy", "same-origin"},
                             {"Cross-Origin-Opener-Policy", "same-origin"}});
        set_handlers();
        accepting_ = std::thread([this] {
            acceptor_ = std::this_thread::get_id();
            listen_after_bind();
        });
        while (!is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ~Http() override {
        is_ending_ = true;
        stop();
        accepting_.join();
    }
    Http(const Http&) = delete;
    Http& operator=(const Http&) = delete;

    int port() const { return port_; }
    const std::string& token() const { return token_; }

  private:
    void bind(int port) {
        errno = 0;
        port_ = port == 0 ? bind_to_any_port(kLoopback) : bind_to_port(kLoopback, port) ? port : -1;
        if (port_ > 0) {
            // With the library's queue of five, the system lets a sixth connection wait for a second.
            constexpr int most_waiting = 128;
            ::listen(svr_sock_, most_waiting);
            return;
        }
        const char* const reason = errno == EACCES ? "only the system's administrator may use it"
                                                   : "it is in use by another program";
        throw InputError(fmt::format(
            "port {} of this machine cannot be used: {}. Choose another port, or leave the choice to Stilb.",
            port, reason));
    }

    void set_handlers() {
        set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            if (const auto refusal = refusal_of(request)) {
                answer(response, *refusal);
            } else if (request.method == "POST") {
                return HandlerResponse::Unhandled;  // its body is not read yet
            } else {
                get(path_of(request), response);
            }
            return HandlerResponse::Handled;
        });
        Post(".*", [this](const httplib::Request& request, httplib::Response& response) {
            answer_by(path_of(request) == "measure" ? handlers_.measure : handlers_.sensors, request.body,
                      response);
        });
        // Of the library's own refusals, which have no text.
        set_error_handler(Handler([](const httplib::Request&, httplib::Response& response) {
            if (response.body.empty()) answer(response, {response.status, "The request is not valid HTTP."});
        }));
        set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
            answer(response, {500, "Stilb could not answer this request, because of an internal error."});
        });
    }

    void get(std::string_view path, httplib::Response& response) const {
        if (path.empty()) return answer(response, handlers_.page.html, "text/html; charset=utf-8");
        if (path == "page.js")
            return answer(response, handlers_.page.script, "text/javascript; charset=utf-8");
        if (path == "page.css") return answer(response, handlers_.page.style, "text/css; charset=utf-8");
        if (path == "state") return answer(response, 200, handlers_.state());
        answer(response, path == "scene" ? handlers_.scene() : handlers_.light());
    }

    /// The path after the token; nothing without the right token.
    std::optional<std::string_view> below_token(const httplib::Request& request) const {
        const std::string_view path = request.path;
        const std::size_t length = token_.size() + 2;
        if (path.size() < length || path.front() != '/' || path[length - 1] != '/') return std::nullopt;
        if (!equal_in_constant_time(path.substr(1, token_.size()), token_)) return std::nullopt;
        return path.substr(length);
    }
    std::string_view path_of(const httplib::Request& request) const { return *below_token(request); }

    /// Whether `name` is one by which a browser on this machine calls this server. Another one means that a
    /// page from elsewhere has directed its own name to this machine (DNS rebinding).
    bool is_own(std::string_view name) const {
        for (const std::string_view host : {"127.0.0.1", "localhost"}) {
            if (name == fmt::format("{}:{}", host, port_)) return true;
            if (port_ == 80 && name == host) return true;
        }
        return false;
    }
    bool is_own_origin(std::string_view origin) const {
        constexpr std::string_view scheme = "http://";
        return origin.starts_with(scheme) && is_own(origin.substr(scheme.size()));
    }

    std::optional<Refusal> refusal_of(const httplib::Request& request) const {
        if (request.get_header_value_count("Host") != 1 || !is_own(request.get_header_value("Host")))
            return Refusal{403, "This server answers to 127.0.0.1 and localhost only."};
        const auto path = below_token(request);
        if (!path) return Refusal{404, "There is nothing at this address."};
        if (request.has_header("Origin") && !is_own_origin(request.get_header_value("Origin")))
            return Refusal{403, "This server answers to its own page only."};
        constexpr std::array<std::string_view, 6> read{"", "page.js", "page.css", "scene", "light", "state"};
        if (std::ranges::find(read, *path) != read.end()) {
            if (request.method == "GET" || request.method == "HEAD") return std::nullopt;
            return Refusal{405, "Only GET is possible here."};
        }
        if (*path != "measure" && *path != "sensors")
            return Refusal{404, "There is nothing at this address."};
        if (request.method != "POST") return Refusal{405, "Only POST is possible here."};
        return refusal_of_body(request);
    }

    /// The body is not read yet: a refused one is never read.
    std::optional<Refusal> refusal_of_body(const httplib::Request& request) const {
        if (!request.get_header_value("Content-Type").starts_with("application/json"))
            return Refusal{415, "The request must be JSON (Content-Type: application/json)."};
        if (request.has_header("Content-Encoding") || request.has_header("Transfer-Encoding"))
            return Refusal{415, "The request must be sent as it is, without compression, in one piece."};
        const auto length = length_of_body(request);
        if (!length) return Refusal{411, "The request must state its length (Content-Length)."};
        if (*length <= limits_.body_bytes) return std::nullopt;
        return Refusal{413, fmt::format("The request is too large: {} bytes. Allowed: {}.", *length,
                                        limits_.body_bytes)};
    }

    bool process_and_close_socket(socket_t socket) override {
        Connection connection(socket, limits_, is_ending_);
        if (std::this_thread::get_id() == acceptor_) return false;  // too many connections
        bool is_accepted = true, is_closed = false;
        while (is_accepted && !is_closed && connection.await_request()) {
            is_accepted = false;
            const bool is_answered =
                process_request(connection, false, is_closed, [&](httplib::Request& request) {
                    // Each response is sent whole and as it is: compressing the page takes longer than
                    // sending it.
                    request.ranges.clear();
                    request.headers.erase("Accept-Encoding");
                    is_accepted = !refusal_of(request);
                    if (is_accepted) return;
                    request.headers.erase("Connection");
                    request.set_header("Connection", "close");
                });
            if (!is_answered) return false;
        }
        if (!is_accepted) connection.end_gently();
        return true;
    }

    walk::Handlers handlers_;
    ServerLimits limits_;
    std::string token_;
    int port_ = 0;
    std::atomic<bool> is_ending_ = false;
    std::thread::id acceptor_;
    std::thread accepting_;
};

Server::Server(Handlers handlers, int port, const ServerLimits& limits)
    : http_(std::make_unique<Http>(std::move(handlers), port, limits)) {}
Server::~Server() = default;

int Server::port() const { return http_->port(); }

std::string Server::address() const {
    return fmt::format("http://{}:{}/{}/", kLoopback, http_->port(), http_->token());
}

}  // namespace stilb::walk
