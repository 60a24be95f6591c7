#include "report/html.h"

namespace stilb::report {
namespace {

void append_escaped(std::string_view plain, std::string& markup) {
    for (const char c : plain) {
        switch (c) {
            case '&':
                markup += "&amp;";
                break;
            case '<':
                markup += "&lt;";
                break;
            case '>':
                markup += "&gt;";
                break;
            case '"':
                markup += "&quot;";
                break;
            default:
                markup += c;
        }
    }
}

std::string opening(std::string_view tag, Attributes attributes) {
    std::string markup = "<";
    markup += tag;
    for (const auto& [name, value] : attributes) {
        markup.append(" ").append(name).append("=\"");
        append_escaped(value, markup);
        markup += '"';
    }
    return markup += '>';
}

std::string_view class_of(Table::Column column) {
    return column == Table::Column::numbers ? "number" : "words";
}

}  // namespace

Html text(std::string_view plain) {
    Html html;
    append_escaped(plain, html.markup_);
    return html;
}

Html name_text(std::string_view name) {
    constexpr std::string_view kSigns = "_.-/:";
    constexpr std::size_t kLongestWord = 24;
    Html html;
    std::size_t from = 0;
    while (from < name.size()) {
        std::size_t end = std::min(name.find_first_of(kSigns, from), name.size() - 1) + 1;
        // Not within a character of several bytes.
        if (end - from > kLongestWord) {
            end = from + kLongestWord;
            while (end < name.size() && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) ++end;
        }
        html += text(name.substr(from, end - from));
        if (end < name.size()) html += void_element("wbr", {});
        from = end;
    }
    return html;
}

Html raw(std::string markup) {
    Html html;
    html.markup_ = std::move(markup);
    return html;
}

Html element(std::string_view tag, Attributes attributes, const Html& content) {
    std::string markup = opening(tag, attributes);
    markup.append(content.markup()).append("</").append(tag).append(">");
    return raw(std::move(markup));
}

Html element(std::string_view tag, const Html& content) { return element(tag, {}, content); }
Html element(std::string_view tag, std::string_view plain) { return element(tag, {}, text(plain)); }

Html void_element(std::string_view tag, Attributes attributes) { return raw(opening(tag, attributes)); }

void Facts::add(std::string_view name, const Html& value) {
    rows_ += element("dt", name) + element("dd", value) + raw("\n");
}

Html Facts::html() const { return element("dl", {{"class", "facts"}}, rows_); }

Table::Table(std::vector<Heading> headings, std::string_view css_class)
    : headings_(std::move(headings)), css_class_(css_class) {}

void Table::add(std::span<const Html> cells) {
    Html row;
    for (std::size_t i = 0; i < cells.size(); ++i)
        row += element("td", {{"class", std::string(class_of(headings_.at(i).column))}}, cells[i]);
    rows_ += element("tr", row) + raw("\n");
}

Html Table::html() const {
    Html row;
    for (const auto& [title, column] : headings_)
        row += element("th", {{"class", std::string(class_of(column))}}, text(title));
    return element("table", {{"class", css_class_}},
                   element("thead", element("tr", row)) + raw("\n") + element("tbody", rows_));
}

}  // namespace stilb::report
