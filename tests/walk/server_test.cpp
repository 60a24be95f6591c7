#include "walk/service/server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "stilb/error.h"

namespace stilb::walk {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// A client that sends what it is told, valid or not.
class Client {
  public:
    explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        is_open_ = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
        const timeval patience{10, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    }
    ~Client() { close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    bool is_open() const { return is_open_; }
    bool send(const std::string& text) {
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t sent = ::send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
            if (sent <= 0) return false;
            done += static_cast<std::size_t>(sent);
        }
        return true;
    }
    /// All until the server closes the connection.
    std::string rest() {
        std::string text;
        char bytes[4096];
        for (ssize_t count; (count = recv(socket_, bytes, sizeof bytes, 0)) > 0;)
            text.append(bytes, static_cast<std::size_t>(count));
        return text;
    }

  private:
    int socket_;
    bool is_open_ = false;
};

struct Answered {
    int status = 0;
    std::string head, body;
};

class ServerTest : public testing::Test {
  protected:
    ServerTest() { start({}); }

    void start(const ServerLimits& limits) {
        server_.reset();
        Handlers handlers;
        handlers.page = {"<html>page</html>", "script", "style"};
        handlers.scene = [this] { return scene_; };
        handlers.light = [] { return Bytes(); };
        handlers.state = [] { return std::string(R"({"done":false})"); };
        handlers.measure = [this](std::string_view body) -> std::string {
            ++measured_;
            if (body == "wrong") throw InputError("This is wrong.");
            if (body == "busy") throw Cancelled("Try again.");
            if (body == "broken") throw std::runtime_error("secret");
            if (body == "slow") std::this_thread::sleep_for(milliseconds(300));
            return std::string(body);
        };
        handlers.sensors = [](std::string_view) { return std::string("{}"); };
        server_ = std::make_unique<Server>(handlers, 0, limits);
        const std::string address = server_->address();
        token_ = address.substr(address.size() - 33, 32);
    }

    std::string host() const { return "127.0.0.1:" + std::to_string(server_->port()); }
    std::string path(const std::string& name) const { return "/" + token_ + "/" + name; }

    Answered ask(const std::string& request) {
        Client client(server_->port());
        client.send(request);
        const std::string text = client.rest();
        Answered answered;
        if (text.starts_with("HTTP/1.1 ")) answered.status = std::stoi(text.substr(9, 3));
        const std::size_t end = text.find("\r\n\r\n");
        answered.head = text.substr(0, end);
        if (end != text.npos) answered.body = text.substr(end + 4);
        return answered;
    }
    Answered get(const std::string& path, const std::string& host, const std::string& more = "",
                 const std::string& method = "GET") {
        return ask(method + " " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + more +
                   "\r\n");
    }
    Answered get(const std::string& path) { return get(path, host()); }
    Answered post(const std::string& name, const std::string& body,
                  const std::string& type = "application/json") {
        return ask("POST " + path(name) + " HTTP/1.1\r\nHost: " + host() +
                   "\r\nConnection: close\r\nContent-Type: " + type +
                   "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }

    Bytes scene_ = std::make_shared<const std::string>(std::string(3'000'000, 'x'));
    std::atomic<int> measured_ = 0;
    std::string token_;
    std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, GivesThePageAndItsData) {
    EXPECT_EQ(get(path("")).body, "<html>page</html>");
    EXPECT_NE(get(path("")).head.find("text/html; charset=utf-8"), std::string::npos);
    EXPECT_EQ(get(path("page.js")).body, "script");
    EXPECT_EQ(get(path("page.css")).body, "style");
    EXPECT_EQ(get(path("state")).body, R"({"done":false})");
    EXPECT_EQ(get(path("scene")).body, *scene_);
    EXPECT_EQ(post("measure", "{}").body, "{}");
    EXPECT_EQ(post("sensors", "1").body, "{}");
    EXPECT_EQ(get(path("state"), "localhost:" + std::to_string(server_->port())).status, 200);
}

TEST_F(ServerTest, SaysThatTheLightIsNotThereYet) {
    const Answered answered = get(path("light"));
    EXPECT_EQ(answered.status, 503);
    EXPECT_NE(answered.body.find("\"error\""), std::string::npos);
}

TEST_F(ServerTest, EveryAnswerHasThePolicy) {
    for (const Answered& answered : {get(path("")), get(path("scene")), get("/"), post("measure", "wrong")}) {
        for (const char* part :
             {"Content-Security-Policy: default-src 'none'; script-src 'self';",
              "X-Content-Type-Options: nosniff", "Cache-Control: no-store", "Referrer-Policy: no-referrer"})
            EXPECT_NE(answered.head.find(part), std::string::npos) << part;
        EXPECT_EQ(answered.head.find("unsafe"), std::string::npos);
    }
}

TEST_F(ServerTest, NothingIsFoundWithoutTheToken) {
    std::string other = token_;
    other.back() = other.back() == '0' ? '1' : '0';
    for (const std::string& wrong : std::vector<std::string>{
             "/", "/scene", "/" + token_, "/" + token_.substr(1) + "/", "/" + other + "/",
             "/" + token_ + "0/", "//" + token_ + "/", "/" + token_ + "//", path("../scene"), path("scene/"),
             path("page.html"), path("%2e%2e/%2e%2e/etc/passwd"), "/favicon.ico", path("scene%00")}) {
        const Answered answered = get(wrong);
        EXPECT_EQ(answered.status, 404) << wrong;
        EXPECT_EQ(answered.body.find(token_), std::string::npos);
    }
}

TEST_F(ServerTest, TheTokenIsNewEachTime) {
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) tokens.insert(random_token());
    EXPECT_EQ(tokens.size(), 100u);
    EXPECT_EQ(tokens.begin()->size(), 32u);
    EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
    EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
    EXPECT_FALSE(equal_in_constant_time("abc", "ab"));
}

TEST_F(ServerTest, AnswersToItsOwnNameOnly) {
    for (const std::string& host :
         std::vector<std::string>{"evil.example", "127.0.0.1", "127.0.0.1:1",
                                  "evil.example:" + std::to_string(server_->port()), ""})
        EXPECT_EQ(get(path(""), host).status, 403) << host;
    EXPECT_EQ(ask("GET " + path("") + " HTTP/1.1\r\nConnection: close\r\n\r\n").status, 403);
    EXPECT_EQ(get(path(""), host(), "Host: evil.example\r\n").status, 403);
}

TEST_F(ServerTest, AnswersToItsOwnPageOnly) {
    EXPECT_EQ(get(path("state"), host(), "Origin: http://" + host() + "\r\n").status, 200);
    for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1"})
        EXPECT_EQ(get(path("state"), host(), std::string("Origin: ") + origin + "\r\n").status, 403)
            << origin;
}

TEST_F(ServerTest, RefusesOtherMethods) {
    EXPECT_EQ(get(path("measure")).status, 405);
    EXPECT_EQ(post("scene", "{}").status, 405);
    for (const char* method : {"PUT", "DELETE", "OPTIONS", "PATCH"})
        EXPECT_EQ(get(path("scene"), host(), "Content-Length: 0\r\n", method).status, 405) << method;
    const Answered head = get(path("scene"), host(), "", "HEAD");
    EXPECT_EQ(head.status, 200);
    EXPECT_EQ(head.body, "");
}

TEST_F(ServerTest, ErrorsOfRequestsAreSentences) {
    EXPECT_EQ(post("measure", "wrong").status, 400);
    EXPECT_EQ(post("measure", "wrong").body, R"({"error":"This is wrong."})");
    EXPECT_EQ(post("measure", "busy").status, 503);
    const Answered broken = post("measure", "broken");
    EXPECT_EQ(broken.status, 500);
    EXPECT_EQ(broken.body.find("secret"), std::string::npos);
}

TEST_F(ServerTest, BodiesAreLimited) {
    EXPECT_EQ(post("measure", std::string(64 * 1024, 'x')).status, 200);
    const int measured = measured_;
    EXPECT_EQ(post("measure", std::string(64 * 1024 + 1, 'x')).status, 413);
    EXPECT_EQ(post("measure", std::string(2'000'000, 'x')).status, 413);
    const std::string head = "POST " + path("measure") + " HTTP/1.1\r\nHost: " + host() +
                             "\r\nContent-Type: application/json\r\nConnection: close\r\n";
    EXPECT_EQ(ask(head + "Content-Length: 99999999999999999999999\r\n\r\n").status, 411);
    EXPECT_EQ(ask(head + "Content-Length: -1\r\n\r\n").status, 411);
    EXPECT_EQ(ask(head + "\r\n").status, 411);
    EXPECT_EQ(ask(head + "Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n").status, 415);
    EXPECT_EQ(ask(head + "Content-Encoding: gzip\r\nContent-Length: 2\r\n\r\n{}").status, 415);
    EXPECT_EQ(post("measure", "{}", "text/plain").status, 415);
    EXPECT_EQ(post("measure", "{}", "multipart/form-data; boundary=x").status, 415);
    EXPECT_EQ(measured_, measured);
}

TEST_F(ServerTest, HeadersAreLimited) {
    std::string many;
    for (int i = 0; i < 100'000; ++i) many += "A: b\r\n";
    EXPECT_NE(get(path(""), host(), many).status, 200);
    EXPECT_NE(get(path(std::string(100'000, 'x'))).status, 200);
    EXPECT_EQ(get(path("")).status, 200);
}

TEST_F(ServerTest, SurvivesWhatIsNotHttp) {
    start({.request = milliseconds(200)});
    for (const std::string& bytes :
         {std::string("\r\n\r\n"), std::string("\x16\x03\x01\x02\x00\x01", 6), std::string(5000, '\0'),
          std::string("GET / HTTP/9.9\r\n\r\n"), std::string("GET \r\n\r\n"), "GET " + path("")})
        EXPECT_NE(ask(bytes).status, 200);
    EXPECT_EQ(get(path("")).status, 200);
}

TEST_F(ServerTest, ConnectionsServeSeveralRequests) {
    const std::string first = "GET " + path("page.js") + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n";
    const std::string last =
        "GET " + path("page.css") + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n";
    const std::string text = [&] {
        Client client(server_->port());
        client.send(first + first + last);
        return client.rest();
    }();
    EXPECT_NE(text.find("script"), text.rfind("script"));
    EXPECT_NE(text.find("style"), std::string::npos);
}

TEST_F(ServerTest, ARefusedBodyIsNoSecondRequest) {
    const std::string hidden = "POST " + path("measure") + " HTTP/1.1\r\nHost: " + host() +
                               "\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}";
    ask("POST /wrong HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: " + std::to_string(hidden.size()) +
        "\r\n\r\n" + hidden);
    EXPECT_EQ(measured_, 0);
}

TEST_F(ServerTest, SlowClientsDoNotStopOthers) {
    start({.request = milliseconds(400), .idle = milliseconds(400)});
    std::vector<std::unique_ptr<Client>> slow;
    for (int i = 0; i < 24; ++i) {
        slow.push_back(std::make_unique<Client>(server_->port()));
        slow.back()->send("GET / HT");
    }
    const auto begin = Clock::now();
    EXPECT_EQ(get(path("state")).status, 200);
    EXPECT_LT(Clock::now() - begin, milliseconds(300));
    // They are dropped, also those that send a byte now and then.
    for (int i = 0; i < 8; ++i) {
        std::this_thread::sleep_for(milliseconds(100));
        slow.front()->send("x");
    }
    slow.front()->rest();
    EXPECT_LT(Clock::now() - begin, milliseconds(2500));
}

TEST_F(ServerTest, ClientsThatDoNotReadAreDropped) {
    start({.response = milliseconds(300)});
    scene_ = std::make_shared<const std::string>(std::string(30'000'000, 'x'));
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < 4; ++i) {
        clients.push_back(std::make_unique<Client>(server_->port()));
        clients.back()->send("GET " + path("scene") + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    }
    std::this_thread::sleep_for(milliseconds(700));
    EXPECT_LT(clients.front()->rest().size(), scene_->size());
    EXPECT_EQ(get(path("state")).status, 200);
}

/// For longer than a client waits.
constexpr milliseconds kForever{60'000};

/// Silent clients, or those that begin a request and never end it.
TEST_F(ServerTest, HeldConnectionsShutNobodyOut) {
    for (const char* const begun : {"", "GET /"}) {
        start({.connections = 8, .request = kForever, .idle = kForever});
        std::vector<std::unique_ptr<Client>> clients;
        for (int i = 0; i < 100; ++i) {
            clients.push_back(std::make_unique<Client>(server_->port()));
            clients.back()->send(begun);
        }
        EXPECT_EQ(clients.front()->rest(), "") << "the oldest is closed";
        for (int i = 0; i < 20; ++i) EXPECT_EQ(get(path("state")).status, 200) << begun << i;
    }
}

/// As many as there are places, one less and one more.
TEST_F(ServerTest, ForOneMoreConnectionTheOldestIsClosed) {
    for (const std::size_t count : {7, 8, 9}) {
        start({.connections = 8, .idle = milliseconds(1000)});
        std::vector<std::unique_ptr<Client>> clients;
        for (std::size_t i = 0; i < count; ++i) {
            clients.push_back(std::make_unique<Client>(server_->port()));
            std::this_thread::sleep_for(milliseconds(5));  // accepted in this order
        }
        const auto begin = Clock::now();
        EXPECT_EQ(clients.front()->rest(), "");
        EXPECT_EQ(Clock::now() - begin < milliseconds(500), count == 9) << "of " << count;
    }
}

/// The page's own connection stays when others that do not know the token come.
TEST_F(ServerTest, ConnectionsWithTheTokenAreKeptLonger) {
    start({.connections = 8, .request = kForever, .idle = kForever});
    const std::string request = "GET " + path("state") + " HTTP/1.1\r\nHost: " + host() + "\r\n";
    Client page(server_->port());
    page.send(request + "\r\n");
    std::this_thread::sleep_for(milliseconds(100));
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < 100; ++i) clients.push_back(std::make_unique<Client>(server_->port()));
    EXPECT_EQ(clients.front()->rest(), "");
    page.send(request + "Connection: close\r\n\r\n");
    const std::string answers = page.rest();
    EXPECT_NE(answers.find("200 OK", answers.find("200 OK") + 1), answers.npos) << "two answers";
}

TEST_F(ServerTest, VanishedClientsDoNoHarm) {
    for (int i = 0; i < 50; ++i) {
        Client client(server_->port());
        client.send("GET " + path("scene") + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    }
    EXPECT_EQ(get(path("state")).status, 200);
}

TEST_F(ServerTest, RequestsAreAnsweredSideBySide) {
    std::vector<std::thread> threads;
    const auto begin = Clock::now();
    for (int i = 0; i < 6; ++i) threads.emplace_back([&] { EXPECT_EQ(post("measure", "slow").status, 200); });
    EXPECT_EQ(get(path("state")).status, 200);
    for (std::thread& thread : threads) thread.join();
    EXPECT_LT(Clock::now() - begin, milliseconds(1200));  // one after the other: 1.8 s
}

TEST_F(ServerTest, EndsAtOnce) {
    Client idle(server_->port()), slow(server_->port()), unread(server_->port());
    slow.send("GET / HT");
    unread.send("GET " + path("scene") + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    std::this_thread::sleep_for(milliseconds(50));
    const auto begin = Clock::now();
    server_.reset();
    EXPECT_LT(Clock::now() - begin, milliseconds(500));
}

TEST_F(ServerTest, ABusyPortIsNamed) {
    try {
        Server second(Handlers{}, server_->port());
        FAIL() << "both have the port";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(server_->port())), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("in use"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("another port"), std::string::npos);
    }
}

TEST_F(ServerTest, ListensOnTheLoopbackOnly) {
    // 127.0.0.2 is this machine, too, but not the address that the server is bound to.
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
    EXPECT_NE(connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    close(socket);
}

}  // namespace
}  // namespace stilb::walk
