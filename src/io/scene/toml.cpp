
#include "io/scene/toml.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>
#include <tuple>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

TomlValue converted(const toml::node& node);

TomlArray converted_array(const toml::array& array) {
    TomlArray result;
    result.reserve(array.size());
    for (const toml::node& element : array) result.push_back(converted(element));
    return result;
}

/// toml++ keeps a table sorted by its keys; positions give back the order of the file.
TomlMembers converted_table(const toml::table& table) {
    std::vector<std::pair<const toml::key*, const toml::node*>> members;
    for (const auto& [key, node] : table) members.emplace_back(&key, &node);
    std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
        const auto position = [](const auto& member) {
            const toml::source_position begin = member.first->source().begin;
            return std::tuple(begin.line, begin.column);
        };
        return position(a) < position(b);
    });
    TomlMembers result;
    result.reserve(members.size());
    for (const auto& [key, node] : members) {
        result.push_back({std::string(key->str()), key->source().begin.line, converted(*node)});
    }
    return result;
}

TomlValue converted(const toml::node& node) {
    TomlValue value;
    value.line = node.source().begin.line;
    if (const toml::table* table = node.as_table()) {
        value.content = converted_table(*table);
    } else if (const toml::array* array = node.as_array()) {
        value.content = converted_array(*array);
    } else if (const auto* text = node.as_string()) {
        value.content = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.content = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        value.content = number->get();
    } else if (const auto* truth = node.as_boolean()) {
        value.content = truth->get();
    }
    return value;
}

/// toml++ limits the nesting of brackets, but follows a.b.c... by recursion until the stack overflows. No
/// separator occurs between the dots of one key.
void expect_shallow_keys(std::string_view text, const std::string& name) {
    constexpr int most_dots = 1000;
    constexpr std::string_view separators = "\n=,[]{}";
    std::size_t line = 1;
    int dots = 0;
    for (const char c : text) {
        if (c == '.' && ++dots > most_dots) {
            throw InputError(
                fmt::format("a key has more than {} parts. No key needs more than four.", most_dots),
                {name, line});
        }
        if (separators.find(c) != std::string_view::npos) dots = 0;
        if (c == '\n') ++line;
    }
}

}  // namespace

TomlValue parse_toml(std::string_view text, const std::string& name) {
    expect_shallow_keys(text, name);
    try {
        return converted(toml::parse(text));
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("not valid TOML: {}", error.description()),
                         {name, error.source().begin.line});
    }
}

namespace {

std::string described(const TomlValue& value) {
    struct Description {
        std::string operator()(TomlDate) const { return "a date or time"; }
        std::string operator()(bool truth) const { return truth ? "true" : "false"; }
        std::string operator()(std::int64_t number) const { return fmt::format("the number {}", number); }
        std::string operator()(double number) const { return fmt::format("the number {}", number); }
        std::string operator()(const std::string& text) const { return "the text " + in_quotes(text); }
        std::string operator()(const TomlArray& array) const {
            return fmt::format("an array of {}", array.size());
        }
        std::string operator()(const TomlMembers&) const { return "a table"; }
        std::string operator()(const TomlVertices& list) const {
            return fmt::format("an array of {}", list->size());
        }
        std::string operator()(const TomlTriangles& list) const {
            return fmt::format("an array of {}", list->size());
        }
    };
    return std::visit(Description{}, value.content);
}

std::string joined(const std::string& path, std::string_view key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-';
    });
    const std::string shown = bare ? std::string(key) : in_quotes(key);
    return path.empty() ? shown : fmt::format("{}.{}", path, shown);
}

std::string with_path(const std::string& path, std::string_view message) {
    return path.empty() ? std::string(message) : fmt::format("{}: {}", path, message);
}

}  // namespace

void TomlItem::fail(std::string_view message) const {
    throw InputError(with_path(path_, message), {*file_, value_->line});
}

std::string TomlItem::where() const { return InputError(path_, {*file_, value_->line}).what(); }

void TomlItem::fail_type(std::string_view needed) const {
    fail(fmt::format("found {} where {} is needed.", described(*value_), needed));
}

double TomlItem::number(const Range& range) const {
    double number = 0;
    if (const auto* real = std::get_if<double>(&value_->content)) {
        number = *real;
    } else if (const auto* integer = std::get_if<std::int64_t>(&value_->content)) {
        number = static_cast<double>(*integer);
    } else {
        fail_type("a number");
    }
    if (!range.contains(number)) fail(refusal(number, range));
    return number;
}

std::int64_t TomlItem::integer(std::int64_t min, std::int64_t max) const {
    if (const auto* integer = std::get_if<std::int64_t>(&value_->content)) {
        if (*integer >= min && *integer <= max) return *integer;
    } else if (const auto* real = std::get_if<double>(&value_->content)) {
        constexpr double exact = 9007199254740992.0;  // 2^53
        if (std::abs(*real) <= exact && *real == std::floor(*real)) {
            const auto whole = static_cast<std::int64_t>(*real);
            if (whole >= min && whole <= max) return whole;
        }
    } else {
        fail_type("a whole number");
    }
    fail(fmt::format("found {}. Allowed: a whole number from {} to {}.", described(*value_), min, max));
}

bool TomlItem::boolean() const {
    const auto* truth = std::get_if<bool>(&value_->content);
    if (truth == nullptr) fail_type("true or false");
    return *truth;
}

const std::string& TomlItem::text() const {
    if (const auto* text = std::get_if<std::string>(&value_->content)) return *text;
    fail_type("a text in quotation marks");
}

TomlItem TomlItem::element(const TomlArray& array, std::size_t index) const {
    return {array[index], fmt::format("{}[{}]", path_, index), *file_};
}

const TomlArray& TomlItem::array_of(std::size_t count, std::string_view needed) const {
    const auto* array = std::get_if<TomlArray>(&value_->content);
    if (!array || array->size() != count) fail_type(needed);
    return *array;
}

Rgb TomlItem::rgb(const Range& range) const {
    const bool is_grey = std::holds_alternative<double>(value_->content) ||
                         std::holds_alternative<std::int64_t>(value_->content);
    if (is_grey) return Rgb::grey(number(range));
    const TomlArray& array = array_of(kBands, "a number or a colour [r, g, b]");
    Rgb rgb;
    for (std::size_t b = 0; b < kBands; ++b) rgb[b] = element(array, b).number(range);
    return rgb;
}

Vec3 TomlItem::vector() const {
    const TomlArray& array = array_of(3, "a triple [x, y, z]");
    return {element(array, 0).number(kCoordinate), element(array, 1).number(kCoordinate),
            element(array, 2).number(kCoordinate)};
}

Vec3 TomlItem::made_unit(const Vec3& v) const {
    const double size = largest_coordinate(v);
    constexpr double smallest = 1e-100;  // its square is still a number
    if (size < smallest) fail("[0, 0, 0] has no direction. Allowed: any other vector.");
    return normalized(v);
}

std::vector<TomlItem> TomlItem::elements() const {
    const auto* array = std::get_if<TomlArray>(&value_->content);
    if (!array) fail_type("an array");
    std::vector<TomlItem> items;
    items.reserve(array->size());
    for (std::size_t i = 0; i < array->size(); ++i) items.push_back(element(*array, i));
    return items;
}

std::vector<double> TomlItem::numbers(std::size_t count, const Range& range) const {
    const TomlArray& array = array_of(count, fmt::format("an array of {} numbers", count));
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(element(array, i).number(range));
    return numbers;
}

TomlTable TomlItem::table() const {
    const auto* members = std::get_if<TomlMembers>(&value_->content);
    if (!members) fail_type("a table");
    return {*members, path_, *file_, value_->line};
}

std::size_t TomlItem::index_in(std::span<const std::string_view> names, std::string_view what,
                               std::span<const std::string_view> later) const {
    const std::string& found = text();
    const auto match = std::find(names.begin(), names.end(), found);
    if (match != names.end()) return static_cast<std::size_t>(match - names.begin());
    const bool known = std::find(later.begin(), later.end(), found) != later.end();
    if (known)
        fail(fmt::format("{} {} is not supported yet.{}", what, in_quotes(found), suggestion("", names)));
    fail(fmt::format("unknown {} {}.{}", what, in_quotes(found), suggestion(found, names)));
}

std::filesystem::path TomlItem::existing_file(const std::filesystem::path& directory) const {
    std::filesystem::path path = directory / text();
    std::error_code error;  // any error means that the file cannot be read
    if (!std::filesystem::is_regular_file(path, error)) {
        fail(fmt::format("there is no file {}. Paths are relative to the scene file; looked for {}.",
                         in_quotes(text()), path.string()));
    }
    return path;
}

TomlTable TomlTable::with(TomlMembers members) const {
    TomlTable table = *this;
    table.kept_ = std::make_shared<const TomlMembers>(std::move(members));
    table.members_ = table.kept_.get();
    return table;
}

void TomlTable::fail(std::string_view message) const {
    throw InputError(with_path(path_, message), {*file_, line_});
}

std::string TomlTable::where() const { return InputError(path_, {*file_, line_}).what(); }

void TomlTable::expect_keys(const std::vector<std::string_view>& allowed, std::string_view kind) {
    kind_ = kind.empty() ? "" : fmt::format(" for {}", kind);
    for (const TomlMember& member : *members_) {
        if (std::find(allowed.begin(), allowed.end(), member.key) != allowed.end()) continue;
        const std::string message =
            fmt::format("unknown key {}{}.{}", in_quotes(member.key), kind_, suggestion(member.key, allowed));
        throw InputError(with_path(path_, message), {*file_, member.line});
    }
}

TomlItem TomlTable::item(const TomlMember& member) const {
    return {member.value, joined(path_, member.key), *file_};
}

std::vector<TomlTable::NamedItem> TomlTable::items() const {
    std::vector<NamedItem> items;
    for (const TomlMember& member : *members_) items.push_back({member.key, item(member)});
    return items;
}

std::optional<TomlItem> TomlTable::find(std::string_view key) const {
    for (const TomlMember& member : *members_) {
        if (member.key == key) return item(member);
    }
    return {};
}

TomlItem TomlTable::at(std::string_view key) const {
    if (const auto item = find(key)) return *item;
    fail(fmt::format("key {} is missing{}.", in_quotes(key), kind_));
}

std::string_view TomlTable::text_of(std::string_view key) const {
    const auto found = std::ranges::find(*members_, key, &TomlMember::key);
    const auto* text = found != members_->end() ? std::get_if<std::string>(&found->value.content) : nullptr;
    return text ? std::string_view(*text) : std::string_view();
}

std::string_view TomlTable::choose(std::string_view key, std::span<const std::string_view> names,
                                   std::span<const std::string_view> later) const {
    const auto item = find(key);
    if (!item) fail(fmt::format("key {} is missing.{}", in_quotes(key), suggestion("", names)));
    return names[item->index_in(names, key, later)];
}

TomlTable::NamedItem TomlTable::one_of(const std::vector<std::string_view>& keys) const {
    std::optional<NamedItem> found;
    std::string named;
    for (const std::string_view key : keys) {
        if (found) expect_not_both(found->key, key);
        const auto item = find(key);
        if (item && !found) found = NamedItem{std::string(key), *item};
        named += named.empty() ? "" : key == keys.back() ? " or " : ", ";
        named += in_quotes(key);
    }
    if (found) return *found;
    fail(fmt::format("key {} is missing{}.", named, kind_));
}

void TomlTable::expect_not_both(std::string_view first, std::string_view second) const {
    if (!has(first)) return;
    if (const auto item = find(second)) {
        item->fail(
            fmt::format("contradicts {}, which is given too. Allowed: one of the two.", in_quotes(first)));
    }
}

}  // namespace stilb::io
