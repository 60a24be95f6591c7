#include "io/import/radiance/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <system_error>

#include "io/import/radiance/compiled_files.h"
#include "io/import/radiance/generators.h"
#include "io/import/radiance/gensky.h"
#include "io/import/radiance/primitives.h"
#include "io/import/radiance/words.h"
#include "io/text/text.h"
#include "io/text/utf8.h"

namespace stilb::io::radiance {
namespace {

constexpr int kDeepest = 64;

/// Reads files, carries out their commands, and collects the primitives.
class Reader {
  public:
    Reader(const ImportOptions& options, const Limits& limits)
        : limits_(limits), collector_(description_, limits) {
        Xform xform;
        xform.transform = options.to_world(UpAxis::z);
        xform.scale = options.scale.value_or(1);
        collector_.set_xform(xform);
    }

    void read(std::string_view text, const std::string& name, const std::filesystem::path& folder) {
        const auto file = add_file(name, folder);
        for (Words words(text); words.skip_to_word();) {
            const Place place{file, words.line()};
            words.at_command() ? run(words.take_command(), place) : read_primitive(words, place);
        }
    }
    /// The primitives that a program prints.
    void read_output(std::string_view text, const Place& place) {
        for (Words words(text); words.skip_to_word();) read_primitive(words, place);
    }
    Description take() && { return std::move(description_); }

  private:
    using Programs = std::vector<std::vector<std::string>>;

    std::uint32_t add_file(const std::string& name, const std::filesystem::path& folder) {
        const auto known = std::ranges::find(description_.files, name);
        if (known != description_.files.end())
            return static_cast<std::uint32_t>(known - description_.files.begin());
        description_.files.push_back(name);
        description_.folders.push_back(folder);
        return static_cast<std::uint32_t>(description_.files.size() - 1);
    }

    [[noreturn]] void fail(const std::string& message, const Place& place) const {
        throw InputError(message, description_.where(place));
    }

    // Primitives

    std::string_view read_word(Words& words, std::string_view what, const Place& place) const {
        const auto word = words.next();
        if (!word) fail(fmt::format("the file ends before the {} of a primitive.", what), place);
        return *word;
    }
    std::size_t read_count(Words& words, std::string_view what, const Primitive& of) const {
        const std::string_view word = read_word(words, what, of.place);
        const auto count = parse_integer(word);
        if (!count || *count < 0) {
            fail(
                fmt::format("found {} where the number of {} of a {} is needed. A primitive is: MODIFIER "
                            "TYPE NAME, then the number of texts and the texts, 0, the number of numbers and "
                            "the numbers.",
                            in_quotes(word), what, of.type),
                {of.place.file, words.line()});
        }
        return static_cast<std::size_t>(*count);
    }
    double read_number(Words& words, const Primitive& of) const {
        const std::string_view word = read_word(words, "numbers", of.place);
        const auto number = parse_number(word);
        if (!number) {
            fail(fmt::format("found {} where a number of a {} is needed.", in_quotes(word), of.type),
                 {of.place.file, words.line()});
        }
        return *number;
    }

    void read_primitive(Words& words, const Place& place) {
        Primitive primitive;
        primitive.place = place;
        primitive.modifier = read_word(words, "modifier", place);
        primitive.type = read_word(words, "type", place);
        const Role role = role_of(primitive.type);
        if (role == Role::unknown) {
            fail(fmt::format("{} is no type of a primitive.{} A primitive is: MODIFIER TYPE NAME, then its "
                             "arguments.",
                             in_quotes(primitive.type), did_you_mean(primitive.type, type_names())),
                 place);
        }
        primitive.name = read_word(words, "name", place);
        if (role == Role::alias) {
            primitive.texts.emplace_back(read_word(words, "original name", place));
            return collector_.add(std::move(primitive));
        }
        for (std::size_t left = read_count(words, "texts", primitive); left > 0; --left)
            primitive.texts.emplace_back(read_word(words, "texts", place));
        for (std::size_t left = read_count(words, "whole numbers", primitive); left > 0; --left)
            read_number(words, primitive);
        for (std::size_t left = read_count(words, "numbers", primitive); left > 0; --left)
            primitive.numbers.push_back(read_number(words, primitive));
        if (role == Role::instance) return read_instance(primitive);
        collector_.add(std::move(primitive));
    }

    /// An octree or a compiled mesh, with transforms.
    void read_instance(const Primitive& primitive) {
        const SourceLocation where = description_.where(primitive.place);
        if (primitive.texts.empty())
            throw InputError(fmt::format("the {} names no file.", primitive.type), where);
        const std::filesystem::path path = find_file(description_, primitive.place, primitive.texts[0]);
        Xform xform;
        const auto transforms = std::span(primitive.texts).subspan(1);
        if (at(primitive.place, [&] { return read_transforms(transforms, xform); }) != transforms.size())
            throw InputError("the texts behind the file are not all transforms.", where);
        const Inside inside(*this, xform, primitive.place);
        const std::string content = read_whole_file(path);
        const std::string name = path.string();
        if (primitive.type == "mesh") {
            const auto modifier = collector_.find(
                collector_.xform().modifier.empty() ? primitive.modifier : collector_.xform().modifier,
                primitive.place);
            add_file(name, path.parent_path());
            add_compiled_mesh(content, name, modifier, primitive, collector_);
        } else {
            read_octree(content, path);
        }
    }
    void read_octree(const std::string& content, const std::filesystem::path& path) {
        const auto file = add_file(path.string(), path.parent_path());
        for (const std::string& part : files_of_octree(content, path.string())) include(part, {file, 0});
    }

    // Commands

    /// Calls `read`, whose errors get the place, unless they have it already.
    template <typename Read>
    auto at(const Place& place, const Read& read) const -> decltype(read()) {
        try {
            return read();
        } catch (const InputError& error) {
            const std::string known = InputError("", description_.where(place)).what();
            if (std::string_view(error.what()).starts_with(known)) throw;
            fail(error.what(), place);
        }
    }

    void run(const std::string& command, const Place& place) {
        run(at(place, [&] { return split_command(command); }), place);
    }
    /// The last program of a pipeline is applied last: it is the outermost transform.
    void run(Programs programs, const Place& place) {
        const std::vector<std::string> last = programs.back();
        programs.pop_back();
        if (!programs.empty() && last.front() != "xform") {
            fail(fmt::format("{} behind a \"|\" is not allowed. Allowed: xform.", in_quotes(last.front())),
                 place);
        }
        const std::vector<std::string> arguments(last.begin() + 1, last.end());
        if (last.front() == "xform") return run_xform(arguments, programs, place);
        if (last.front() == "cat") {
            for (const std::string& name : arguments) include(name, place);
        } else if (last.front() == "genbox") {
            at(place, [&] { run_genbox(arguments, place, collector_); });
        } else if (last.front() == "gensky") {
            read_output(at(place, [&] { return gensky(arguments); }), place);
        } else {
            fail(
                fmt::format("the command {} cannot be run, because Stilb runs no other programs. Allowed: "
                            "xform, genbox, gensky, cat. Or let a shell run it once, and include its output: "
                            "!cat FILE.",
                            in_quotes(last.front())),
                place);
        }
    }

    void run_xform(const std::vector<std::string>& arguments, const Programs& before, const Place& place) {
        const auto read_file = [&](const std::string& name) {
            return read_text_file(find_file(description_, place, name));
        };
        const XformCommand command =
            at(place, [&] { return read_xform(arguments, read_file, limits_.primitives); });
        if (command.files.empty() == before.empty()) {
            fail(command.files.empty() ? "xform has no file to read. Needed: xform TRANSFORMS FILE."
                                       : "xform reads a file, and so not what is behind the \"|\".",
                 place);
        }
        std::size_t made = 0;
        for (const Xform& xform : command.copies) {
            const Inside inside(*this, xform, place);
            const std::size_t size = collector_.size();
            if (!before.empty()) run(before, place);
            for (const std::string& name : command.files) include(name, place);
            // Copies of nothing could be repeated for ever.
            made += collector_.size() - size;
            if (made == 0) break;
        }
    }

    void include(const std::string& name, const Place& place) {
        const std::filesystem::path path = find_file(description_, place, name);
        const Inside inside(*this, {}, place);
        read(contents_of(path), path.string(), path.parent_path());
    }
    /// The content of a file, which arrays read many times.
    const std::string& contents_of(const std::filesystem::path& path) {
        for (const auto& [known, content] : contents_) {
            if (known == path) return *content;
        }
        contents_.emplace_back(path, std::make_unique<const std::string>(read_text_file(path)));
        return *contents_.back().second;
    }

    /// The primitives of its scope lie inside a transform.
    class Inside {
      public:
        Inside(Reader& reader, const Xform& xform, const Place& place)
            : reader_(reader), before_(reader.collector_.xform()) {
            if (++reader_.depth_ > kDeepest) reader_.fail("files include each other without end.", place);
            reader_.collector_.set_xform(before_.after(xform));
        }
        ~Inside() {
            --reader_.depth_;
            reader_.collector_.set_xform(before_);
        }
        Inside(const Inside&) = delete;
        Inside& operator=(const Inside&) = delete;

      private:
        Reader& reader_;
        Xform before_;
    };

    Limits limits_;
    Description description_;
    Collector collector_;
    std::vector<std::pair<std::filesystem::path, std::unique_ptr<const std::string>>> contents_;
    int depth_ = 0;
};

/// The folders of RAYPATH, Radiance's libraries. As in Radiance, names that begin with a dot are not looked
/// for there.
std::vector<std::filesystem::path> library_folders(const std::string& name) {
    std::vector<std::filesystem::path> folders;
    const char* const variable = std::getenv("RAYPATH");
    if (variable == nullptr || name.starts_with('.')) return folders;
    std::string_view rest = variable;
    while (!rest.empty()) {
        const std::string_view folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
        if (!folder.empty()) folders.emplace_back(folder);
    }
    return folders;
}

}  // namespace

Description read_description(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder, const ImportOptions& options,
                             const Limits& limits) {
    Reader reader(options, limits);
    reader.read(text, name, folder);
    return std::move(reader).take();
}

std::filesystem::path find_file(const Description& description, const Place& place, const std::string& name) {
    std::error_code error;
    std::vector<std::filesystem::path> folders{description.folders[place.file], description.folders.front()};
    std::ranges::copy(library_folders(name), std::back_inserter(folders));
    for (const std::filesystem::path& folder : folders) {
        std::filesystem::path path = (folder / name).lexically_normal();
        if (std::filesystem::is_regular_file(path, error)) return path;
    }
    throw InputError(
        fmt::format(
            "there is no file {}, neither beside this file, nor beside the scene's, nor in a folder of the "
            "environment variable RAYPATH{}.",
            in_quotes(name), std::getenv("RAYPATH") == nullptr ? ", which is not set" : ""),
        description.where(place));
}

}  // namespace stilb::io::radiance
