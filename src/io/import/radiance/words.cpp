#include "io/import/radiance/words.h"

#include <fmt/format.h>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::radiance {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// The arguments of a pipeline, in the words of a shell.
class CommandSplitter {
  public:
    explicit CommandSplitter(std::string_view command) : rest_(command) {}

    std::vector<std::vector<std::string>> split() && {
        while (!rest_.empty()) take();
        end_word();
        for (const std::vector<std::string>& program : programs_) {
            if (program.empty()) throw InputError("the command is incomplete: a program is missing.");
        }
        return std::move(programs_);
    }

  private:
    void take() {
        const char c = rest_.front();
        rest_.remove_prefix(1);
        if (is_space(c)) return end_word();
        if (c == '\'' || c == '"') return take_quoted(c);
        if (c == '\\' && !rest_.empty()) {
            add(rest_.front());
            return rest_.remove_prefix(1);
        }
        if (c == '#' && !word_) return rest_.remove_prefix(rest_.size());
        if (c == '|') {
            end_word();
            return programs_.emplace_back(), void();
        }
        constexpr std::string_view of_shells = ";&<>`$()*?";
        if (of_shells.find(c) != of_shells.npos) {
            throw InputError(fmt::format(
                "the command contains {}, which a shell would interpret. Stilb runs no shell. Allowed: "
                "xform, genbox, gensky and cat, joined by \"|\"; other characters in quotes.",
                in_quotes({&c, 1})));
        }
        add(c);
    }
    void take_quoted(char quote) {
        const std::size_t end = rest_.find(quote);
        if (end == rest_.npos) throw InputError("a quote in the command is not closed.");
        for (const char c : rest_.substr(0, end)) add(c);
        if (!word_) word_.emplace();
        rest_.remove_prefix(end + 1);
    }
    void add(char c) {
        if (!word_) word_.emplace();
        *word_ += c;
    }
    void end_word() {
        if (word_) programs_.back().push_back(std::move(*word_));
        word_.reset();
    }

    std::string_view rest_;
    std::optional<std::string> word_;
    std::vector<std::vector<std::string>> programs_{1};
};

}  // namespace

bool Words::skip_to_word() {
    for (; position_ < text_.size(); ++position_) {
        if (text_[position_] == '#') position_ = std::min(text_.find('\n', position_), text_.size());
        if (position_ == text_.size()) break;
        if (text_[position_] == '\n') ++line_;
        if (!is_space(text_[position_])) return true;
    }
    return false;
}

std::optional<std::string_view> Words::next() {
    if (!skip_to_word()) return std::nullopt;
    const char quote = text_[position_];
    if (quote == '"' || quote == '\'') {
        const std::size_t begin = position_ + 1, end = std::min(text_.find(quote, begin), text_.size());
        const std::string_view word = text_.substr(begin, end - begin);
        for (const char c : word) line_ += c == '\n';
        position_ = std::min(end + 1, text_.size());
        return word;
    }
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
    return text_.substr(begin, position_ - begin);
}

std::string Words::take_command() {
    std::string command;
    ++position_;
    for (; position_ < text_.size() && text_[position_] != '\n'; ++position_) {
        const std::string_view rest = text_.substr(position_);
        const std::size_t joint = rest.starts_with("\\\n") ? 1 : rest.starts_with("\\\r\n") ? 2 : 0;
        if (joint > 0) {
            command += ' ';
            position_ += joint;
            ++line_;
        } else {
            command += text_[position_];
        }
    }
    return command;
}

std::vector<std::vector<std::string>> split_command(std::string_view command) {
    return CommandSplitter(command).split();
}

std::vector<std::string> split_arguments(std::string_view line) {
    std::vector<std::vector<std::string>> programs = split_command(line);
    if (programs.size() > 1) throw InputError("found \"|\" where arguments of xform are needed.");
    return std::move(programs.front());
}

}  // namespace stilb::io::radiance
