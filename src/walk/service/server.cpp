#include "walk/service/server.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>
// Boost's coroutines need <utility> before them.
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>

#include "stilb/error.h"

namespace stilb::walk {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;

using RequestParser = http::request_parser<http::string_body>;
using Request = RequestParser::value_type;

/// The threads that compute answers. Connections that wait have no thread.
constexpr std::size_t kWorkers = 16;
/// Connections that the system keeps until they are accepted.
constexpr int kBacklog = 128;

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
    "'self'; "
    "worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

struct Answer {
    http::status status = http::status::ok;
    const char* type = "application/json";
    Bytes body;
};

Answer answer_of(std::string_view text, const char* type = "application/json") {
    return {http::status::ok, type, std::make_shared<const std::string>(text)};
}

Answer refusal(http::status status, const std::string& message) {
    Answer answer = answer_of(
        nlohmann::json{{"error", message}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    answer.status = status;
    return answer;
}

Answer answer_of(Bytes bytes) {
    if (!bytes) return refusal(http::status::service_unavailable, "This is not computed yet. Ask again.");
    return {http::status::ok, "application/octet-stream", std::move(bytes)};
}

/// Calls the handler of a POST request.
Answer answer_by(const std::function<std::string(std::string_view)>& handler, const std::string& body) {
    try {
        return answer_of(handler(body));
    } catch (const InputError& error) {
        return refusal(http::status::bad_request, error.what());
    } catch (const Cancelled& error) {
        return refusal(http::status::service_unavailable, error.what());
    }
}

/// To a request that could not be read; nothing where the client is gone or too slow.
std::optional<Answer> answer_to_unread(const error_code& failure) {
    using http::error;
    if (failure.category() != make_error_code(error::bad_method).category() ||
        failure == error::end_of_stream || failure == error::partial_message)
        return std::nullopt;
    if (failure == error::header_limit)
        return refusal(http::status::request_header_fields_too_large,
                       "The header of the request is too large.");
    if (failure == error::bad_content_length)
        return refusal(http::status::length_required,
                       "The request must state its length in bytes (Content-Length).");
    return refusal(http::status::bad_request, "The request is not valid HTTP.");
}

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

/// The value of a header field; empty if the request has no such field.
std::string_view value_of(const Request& request, http::field field) { return view_of(request[field]); }

/// A connection that has a place among those that are kept.
struct Connection {
    explicit Connection(tcp::socket socket) : stream(std::move(socket)) {}

    beast::tcp_stream stream;
    bool is_trusted = false;   ///< has asked with the token
    bool is_answered = false;  ///< its request is being answered
};

/// Ends the connection after a refusal: reads and forgets, for a short time, what the client still sends.
/// With unread bytes left, closing would make the system discard the answer.
asio::awaitable<void> end_gently(beast::tcp_stream& stream) {
    stream.socket().shutdown(tcp::socket::shutdown_send);
    stream.expires_after(std::chrono::milliseconds(200));
    std::array<char, 4096> forgotten;
    while (true) co_await stream.async_read_some(asio::buffer(forgotten), asio::use_awaitable);
}

asio::awaitable<void> send(beast::tcp_stream& stream, const Answer& answer, bool is_head, bool is_open) {
    http::response<http::span_body<const char>> response(answer.status, 11);
    response.set(http::field::content_type, answer.type);
    response.set("Content-Security-Policy", kPolicy);
    response.set("X-Content-Type-Options", "nosniff");
    response.set(http::field::cache_control, "no-store");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.keep_alive(is_open);
    response.body() = {answer.body->data(), answer.body->size()};
    response.prepare_payload();
    http::response_serializer<http::span_body<const char>> serializer(response);
    if (is_head) {
        co_await http::async_write_header(stream, serializer, asio::use_awaitable);
    } else {
        co_await http::async_write(stream, serializer, asio::use_awaitable);
    }
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

class Server::Http {
  public:
    Http(walk::Handlers handlers, int port, const ServerLimits& limits)
        : handlers_(std::move(handlers)), limits_(limits), token_(random_token()) {
        bind(port);
        asio::co_spawn(context_, accept(), asio::detached);
        serving_ = std::thread([this] { context_.run(); });
    }
    ~Http() {
        context_.stop();
        serving_.join();
        workers_.join();
    }
    Http(const Http&) = delete;
    Http& operator=(const Http&) = delete;

    int port() const { return port_; }
    const std::string& token() const { return token_; }

  private:
    void bind(int port) try {
        const tcp::endpoint loopback(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
        acceptor_.open(loopback.protocol());
        acceptor_.set_option(tcp::acceptor::reuse_address(true));
        acceptor_.bind(loopback);
        acceptor_.listen(kBacklog);
        port_ = acceptor_.local_endpoint().port();
    } catch (const boost::system::system_error& error) {
        const char* const reason = error.code() == asio::error::access_denied
                                       ? "only the system's administrator may use it"
                                       : "it is in use by another program";
        throw InputError(fmt::format(
            "port {} of this machine cannot be used: {}. Choose another port, or leave the choice to Stilb.",
            port, reason));
    }

    asio::awaitable<void> accept() {
        while (true) {
            error_code failure;
            tcp::socket socket =
                co_await acceptor_.async_accept(asio::redirect_error(asio::use_awaitable, failure));
            if (failure) {  // too many open files, say
                asio::steady_timer pause(context_, std::chrono::milliseconds(50));
                co_await pause.async_wait(asio::use_awaitable);
            } else if (has_place()) {
                const auto connection = std::make_shared<Connection>(std::move(socket));
                connections_.push_back(connection);
                asio::co_spawn(context_, serve(connection), asio::detached);
            }
        }
    }

    /// Where all places are taken, ends a connection that waits: the oldest without the token, or else the
    /// oldest of all. Otherwise programs that hold connections open would shut the user out. False where all
    /// are being answered.
    bool has_place() {
        std::erase_if(connections_, [](const auto& connection) { return connection.expired(); });
        if (connections_.size() < limits_.connections) return true;
        const auto oldest_waiting = [&](bool is_trusted) {
            return std::ranges::find_if(connections_, [&](const auto& weak) {
                const std::shared_ptr<Connection> connection = weak.lock();
                return !connection->is_answered && connection->is_trusted == is_trusted;
            });
        };
        auto dropped = oldest_waiting(false);
        if (dropped == connections_.end()) dropped = oldest_waiting(true);
        if (dropped == connections_.end()) return false;
        dropped->lock()->stream.close();  // ends serve()
        connections_.erase(dropped);
        return true;
    }

    /// The requests of a connection, one after the other. Ends by an exception where the client goes, or
    /// takes longer than the limits say.
    asio::awaitable<void> serve(std::shared_ptr<Connection> connection) {
        beast::tcp_stream& stream = connection->stream;
        stream.socket().set_option(tcp::no_delay(true));
        beast::flat_buffer buffer;
        do {
            if (buffer.size() == 0) {
                stream.expires_after(limits_.idle);
                buffer.commit(co_await stream.async_read_some(buffer.prepare(4096), asio::use_awaitable));
            }
        } while (co_await serve_one(*connection, buffer));
        co_await end_gently(stream);
    }

    /// Whether another request may follow.
    asio::awaitable<bool> serve_one(Connection& connection, beast::flat_buffer& buffer) {
        beast::tcp_stream& stream = connection.stream;
        stream.expires_after(limits_.request);
        RequestParser parser;
        parser.header_limit(static_cast<std::uint32_t>(limits_.header_bytes));
        // No limit yet: refusal_of() checks first who asks, then the length.
        parser.body_limit(std::numeric_limits<std::uint64_t>::max());
        error_code failure;
        co_await http::async_read_header(stream, buffer, parser,
                                         asio::redirect_error(asio::use_awaitable, failure));
        std::optional<Answer> refused = failure ? answer_to_unread(failure) : refusal_of(parser);
        if (!failure && !refused) {  // the body of a refused request is never read
            connection.is_trusted = true;
            co_await http::async_read(stream, buffer, parser,
                                      asio::redirect_error(asio::use_awaitable, failure));
            if (failure) refused = answer_to_unread(failure);
        }
        if (failure && !refused) throw boost::system::system_error(failure);

        const Request& request = parser.get();
        const bool is_open = !refused && request.keep_alive();
        if (!refused) {
            connection.is_answered = true;
            stream.expires_never();
            refused = co_await computed_answer(request);
        }
        stream.expires_after(limits_.response);
        co_await send(stream, *refused, request.method() == http::verb::head, is_open);
        connection.is_answered = false;
        co_return is_open;
    }

    /// Handlers may take long: they run in threads of their own.
    asio::awaitable<Answer> computed_answer(const Request& request) {
        const auto compute = [&]() -> asio::awaitable<Answer> { co_return answer_to(request); };
        co_return co_await asio::co_spawn(workers_, compute, asio::use_awaitable);
    }

    Answer answer_to(const Request& request) const {
        const std::string_view path = path_of(request);
        try {
            if (path == "measure") return answer_by(handlers_.measure, request.body());
            if (path == "sensors") return answer_by(handlers_.sensors, request.body());
            if (path == "page.js") return answer_of(handlers_.page.script, "text/javascript; charset=utf-8");
            if (path == "page.css") return answer_of(handlers_.page.style, "text/css; charset=utf-8");
            if (path == "state") return answer_of(handlers_.state());
            if (path == "scene") return answer_of(handlers_.scene());
            if (path == "light") return answer_of(handlers_.light());
            return answer_of(handlers_.page.html, "text/html; charset=utf-8");
        } catch (const std::exception&) {
            return refusal(http::status::internal_server_error,
                           "Stilb could not answer this request, because of an internal error.");
        }
    }

    /// The path after the token, without a query; nothing without the right token.
    std::optional<std::string_view> below_token(const Request& request) const {
        const std::string_view target = view_of(request.target()), path = target.substr(0, target.find('?'));
        const std::size_t length = token_.size() + 2;
        if (path.size() < length || path.front() != '/' || path[length - 1] != '/') return std::nullopt;
        if (!equal_in_constant_time(path.substr(1, token_.size()), token_)) return std::nullopt;
        return path.substr(length);
    }
    std::string_view path_of(const Request& request) const { return *below_token(request); }

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

    /// Checks a request before its body is read.
    std::optional<Answer> refusal_of(const RequestParser& parser) const {
        using http::status, http::verb;
        const Request& request = parser.get();
        if (request.count(http::field::host) != 1 || !is_own(value_of(request, http::field::host)))
            return refusal(status::forbidden, "This server answers to 127.0.0.1 and localhost only.");
        const auto path = below_token(request);
        if (!path) return refusal(status::not_found, "There is nothing at this address.");
        if (request.count(http::field::origin) != 0 && !is_own_origin(value_of(request, http::field::origin)))
            return refusal(status::forbidden, "This server answers to its own page only.");
        constexpr std::array<std::string_view, 6> read{"", "page.js", "page.css", "scene", "light", "state"};
        const bool is_read = std::ranges::find(read, *path) != read.end();
        if (!is_read && *path != "measure" && *path != "sensors")
            return refusal(status::not_found, "There is nothing at this address.");
        if (is_read && request.method() != verb::get && request.method() != verb::head)
            return refusal(status::method_not_allowed, "Only GET is possible here.");
        if (!is_read && request.method() != verb::post)
            return refusal(status::method_not_allowed, "Only POST is possible here.");
        return refusal_of_body(parser, !is_read);
    }

    std::optional<Answer> refusal_of_body(const RequestParser& parser, bool needs_body) const {
        using http::status;
        const Request& request = parser.get();
        if (needs_body && !value_of(request, http::field::content_type).starts_with("application/json"))
            return refusal(status::unsupported_media_type,
                           "The request must be JSON (Content-Type: application/json).");
        if (request.count(http::field::content_encoding) + request.count(http::field::transfer_encoding) != 0)
            return refusal(status::unsupported_media_type,
                           "The request must be sent as it is, without compression, in one piece.");
        const auto length = parser.content_length();
        if (needs_body && !length)
            return refusal(status::length_required,
                           "The request must state its length in bytes (Content-Length).");
        if (!length || *length <= limits_.body_bytes) return std::nullopt;
        return refusal(
            status::payload_too_large,
            fmt::format("The request is too large: {} bytes. Allowed: {}.", *length, limits_.body_bytes));
    }

    walk::Handlers handlers_;
    ServerLimits limits_;
    std::string token_;
    int port_ = 0;
    std::vector<std::weak_ptr<Connection>> connections_;  ///< the oldest first
    asio::io_context context_{1};                         // outlives the workers, which hand it their answers
    asio::thread_pool workers_{kWorkers};
    tcp::acceptor acceptor_{context_};
    std::thread serving_;
};

Server::Server(Handlers handlers, int port, const ServerLimits& limits)
    : http_(std::make_unique<Http>(std::move(handlers), port, limits)) {}
Server::~Server() = default;

int Server::port() const { return http_->port(); }

std::string Server::address() const {
    return fmt::format("http://127.0.0.1:{}/{}/", http_->port(), http_->token());
}

}  // namespace stilb::walk
