#include "io/import/radiance/xform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/import/radiance/words.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::radiance {
namespace {

using geometry::Transform;

constexpr double kLargestNumber = 1e9;
constexpr long long kMostRepetitions = 1'000'000;

double number_of(std::span<const std::string> arguments, std::size_t at) {
    if (at >= arguments.size())
        throw InputError(fmt::format("{} needs more numbers behind it.", in_quotes(arguments.front())));
    const auto number = parse_number(arguments[at]);
    if (!number || std::abs(*number) > kLargestNumber) {
        throw InputError(fmt::format("{} behind {} is not allowed. Allowed: a number from -1e9 to 1e9.",
                                     in_quotes(arguments[at]), in_quotes(arguments.front())));
    }
    return *number;
}

std::size_t count_of(std::span<const std::string> arguments, long long least) {
    const auto count = arguments.size() > 1 ? parse_integer(arguments[1]) : std::nullopt;
    if (!count || *count < least || *count > kMostRepetitions) {
        throw InputError(fmt::format("a count is needed behind {}: a whole number from {} to {}.",
                                     in_quotes(arguments.front()), least, kMostRepetitions));
    }
    return static_cast<std::size_t>(*count);
}

/// One transform, and its number of arguments; 0 arguments where it is none.
struct Step {
    Transform transform;
    double scale = 1;
    std::size_t arguments = 0;
};

Vec3 axis_of(char name) { return {name == 'x' ? 1. : 0., name == 'y' ? 1. : 0., name == 'z' ? 1. : 0.}; }

Transform mirror(char axis) {
    Transform transform;
    Vec3& own = axis == 'x' ? transform.x_axis : axis == 'y' ? transform.y_axis : transform.z_axis;
    own = -own;
    return transform;
}

Step read_step(std::span<const std::string> arguments) {
    const std::string& option = arguments.front();
    const bool has_axis = option.size() == 3 && option[2] >= 'x' && option[2] <= 'z';
    if (option == "-t") {
        Transform moved;
        moved.translation = {number_of(arguments, 1), number_of(arguments, 2), number_of(arguments, 3)};
        return {moved, 1, 4};
    }
    if (option == "-s") {
        const double factor = number_of(arguments, 1);
        if (factor == 0) throw InputError("the scale behind \"-s\" is 0. Allowed: other numbers.");
        return {Transform::scaling(factor), factor, 2};
    }
    if (option.starts_with("-r") && has_axis)
        return {Transform::rotation(axis_of(option[2]), number_of(arguments, 1)), 1, 2};
    if (option.starts_with("-m") && has_axis) return {mirror(option[2]), -1, 1};
    return {};
}

/// Transforms up to the next -i, which together are repeated.
struct Repeated {
    Transform transform;
    double scale = 1;
    std::size_t times = 1;

    void add_to(Xform& xform) const {
        for (std::size_t i = 0; i < times; ++i) {
            xform.transform = compose(transform, xform.transform);
            xform.scale *= scale;
        }
    }
};

}  // namespace

Xform Xform::after(const Xform& inner) const {
    return {compose(transform, inner.transform),
            scale * inner.scale,
            is_mirrored != inner.is_mirrored,
            is_inverted != inner.is_inverted,
            modifier.empty() ? inner.modifier : modifier,
            prefix + inner.prefix};
}

std::size_t read_transforms(std::span<const std::string> arguments, Xform& result) {
    std::size_t used = 0;
    Repeated repeated;
    while (used < arguments.size()) {
        const auto rest = arguments.subspan(used);
        if (rest.front() == "-i") {
            repeated.add_to(result);
            repeated = {{}, 1, count_of(rest, 0)};
            used += 2;
            continue;
        }
        const Step step = read_step(rest);
        if (step.arguments == 0) break;
        repeated.transform = compose(step.transform, repeated.transform);
        repeated.scale *= step.scale;
        used += step.arguments;
    }
    repeated.add_to(result);
    if (result.scale < 0) {
        result.is_mirrored = true;
        result.scale = -result.scale;
    }
    if (!(result.scale > 1e-100 && result.scale < 1e100 && length(result.transform.translation) < 1e100))
        throw InputError("the transforms lead to numbers that are too large or too small.");
    return used;
}

namespace {

class XformReader {
  public:
    XformReader(const std::function<std::string(const std::string&)>& read_file, std::size_t most)
        : read_file_(read_file), most_(most) {}

    /// As xform does: first the argument files, then the arrays, from the left.
    void read(const std::vector<std::string>& arguments) {
        const auto file = std::ranges::find(arguments, "-f");
        if (file != arguments.end()) return read_argument_file(arguments, file - arguments.begin());
        const auto array = std::ranges::find(arguments, "-a");
        if (array != arguments.end()) return read_array(arguments, array - arguments.begin());
        read_plain(arguments);
    }
    XformCommand take() && { return std::move(command_); }

  private:
    /// The arguments with the name `-n NAME` numbered, or with a new one in front.
    static std::vector<std::string> numbered(std::vector<std::string> arguments, std::size_t number,
                                             std::string_view letter) {
        bool is_named = false;
        for (std::size_t i = 1; i < arguments.size(); ++i) {
            if (arguments[i - 1] != "-n") continue;
            arguments[i] = fmt::format("{}.{}", arguments[i], number);
            is_named = true;
        }
        if (!is_named) arguments.insert(arguments.begin(), {"-n", fmt::format("{}{}", letter, number)});
        return arguments;
    }

    void read_array(const std::vector<std::string>& arguments, std::ptrdiff_t at) {
        const std::size_t count = count_of(std::span(arguments).subspan(static_cast<std::size_t>(at)), 1);
        std::vector<std::string> copy = arguments;
        copy[static_cast<std::size_t>(at)] = "-i";
        for (std::size_t i = 0; i < count; ++i) {
            copy[static_cast<std::size_t>(at) + 1] = std::to_string(i);
            read(numbered(copy, i, "a"));
        }
    }

    void read_argument_file(const std::vector<std::string>& arguments, std::ptrdiff_t at) {
        if (at + 1 >= std::ssize(arguments)) throw InputError("the file behind \"-f\" is missing.");
        if (++depth_ > 8) throw InputError("argument files of xform refer to each other without end.");
        const std::string content = read_file_(arguments[static_cast<std::size_t>(at) + 1]);
        std::size_t number = 0;
        for (TextLines lines(content); lines.next();) {
            std::string_view line = trimmed(lines.line());
            if (line.empty() || line.front() == '#') continue;
            if (line.front() == '!') line.remove_prefix(1);
            if (line.starts_with("xform ")) line.remove_prefix(6);
            std::vector<std::string> all(arguments.begin(), arguments.begin() + at);
            for (std::string& word : split_arguments(line)) all.push_back(std::move(word));
            all.insert(all.end(), arguments.begin() + at + 2, arguments.end());
            read(numbered(std::move(all), number++, "i"));
        }
        --depth_;
    }

    void read_plain(const std::vector<std::string>& arguments) {
        if (command_.copies.size() >= most_)
            throw InputError(fmt::format("xform makes more than {} copies.", most_));
        Xform xform;
        std::size_t at = 0;
        const auto value = [&]() -> const std::string& {
            if (at + 1 >= arguments.size())
                throw InputError(fmt::format("the name behind {} is missing.", in_quotes(arguments[at])));
            return arguments[++at];
        };
        for (; at < arguments.size(); ++at) {
            const std::string& option = arguments[at];
            if (option == "-m") {
                const std::string& name = value();
                if (xform.modifier.empty()) xform.modifier = name;
            } else if (option == "-n") {
                xform.prefix += value() + ".";
            } else if (option == "-I") {
                xform.is_inverted = !xform.is_inverted;
            } else if (option != "-c" && option != "-e") {
                break;
            }
        }
        at += read_transforms(std::span(arguments).subspan(at), xform);
        if (at < arguments.size() && arguments[at].starts_with("-")) {
            throw InputError(fmt::format(
                "xform: {} is not allowed here. Allowed: -m, -n, -I, -c, -e, -f, then -t, -rx, -ry, -rz, -s, "
                "-mx, -my, -mz, -a, -i, then files.",
                in_quotes(arguments[at])));
        }
        command_.files.assign(arguments.begin() + static_cast<std::ptrdiff_t>(at), arguments.end());
        command_.copies.push_back(std::move(xform));
    }

    const std::function<std::string(const std::string&)>& read_file_;
    std::size_t most_;
    int depth_ = 0;
    XformCommand command_;
};

}  // namespace

XformCommand read_xform(const std::vector<std::string>& arguments,
                        const std::function<std::string(const std::string&)>& read_file, std::size_t most) {
    XformReader reader(read_file, most);
    reader.read(arguments);
    return std::move(reader).take();
}

}  // namespace stilb::io::radiance
