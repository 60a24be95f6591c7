// Markup of HTML and SVG. Texts become markup here alone, where they are escaped.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stilb::report {

/// Well-formed markup: made by the functions below only.
class Html {
  public:
    Html() = default;

    const std::string& markup() const { return markup_; }
    bool is_empty() const { return markup_.empty(); }
    Html& operator+=(const Html& more) {
        markup_ += more.markup_;
        return *this;
    }
    friend Html operator+(Html first, const Html& second) { return first += second; }

  private:
    friend Html text(std::string_view);
    friend Html raw(std::string);
    std::string markup_;
};

/// A text, with references in place of the characters that markup consists of.
Html text(std::string_view plain);
/// A name or a path, which may be broken into lines after signs between its words.
Html name_text(std::string_view name);
/// A text that is markup already, such as a style sheet.
Html raw(std::string markup);

struct Attribute {
    std::string_view name;
    std::string value;
};
using Attributes = std::initializer_list<Attribute>;

/// <tag name="value" ...>content</tag>
Html element(std::string_view tag, Attributes attributes, const Html& content = {});
Html element(std::string_view tag, const Html& content);
Html element(std::string_view tag, std::string_view plain);
/// An element that has no content in HTML: <img ...>, <meta ...>.
Html void_element(std::string_view tag, Attributes attributes);

/// Names with values.
class Facts {
  public:
    void add(std::string_view name, const Html& value);
    Html html() const;

  private:
    Html rows_;
};

/// A table, row by row.
class Table {
  public:
    /// Columns of numbers are aligned to the right.
    enum class Column { words, numbers };
    struct Heading {
        std::string title;
        Column column = Column::words;
    };
    /// `css_class`: of the table; may be empty.
    explicit Table(std::vector<Heading> headings, std::string_view css_class = "");

    void add(std::span<const Html> cells);
    void add(std::initializer_list<Html> cells) { add(std::span(cells.begin(), cells.size())); }
    bool is_empty() const { return rows_.is_empty(); }
    Html html() const;

  private:
    std::vector<Heading> headings_;
    std::string css_class_;
    Html rows_;
};

}  // namespace stilb::report
