#include "report/html.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace stilb::report {
namespace {

TEST(Html, EscapesTextsAndAttributes) {
    EXPECT_EQ(text("a < b & c > \"d\"").markup(), "a &lt; b &amp; c &gt; &quot;d&quot;");
    EXPECT_EQ(element("p", {{"title", "\"><script>"}}, text("1 < 2")).markup(),
              "<p title=\"&quot;&gt;&lt;script&gt;\">1 &lt; 2</p>");
    EXPECT_EQ(element("b", "a & b").markup(), "<b>a &amp; b</b>");
    EXPECT_EQ(void_element("img", {{"alt", "<&>"}}).markup(), "<img alt=\"&lt;&amp;&gt;\">");
}

TEST(Html, JoinsMarkup) {
    Html html = element("i", "1") + text("&");
    html += raw("<br>");
    EXPECT_EQ(element("p", html).markup(), "<p><i>1</i>&amp;<br></p>");
    EXPECT_TRUE(Html{}.is_empty());
    EXPECT_FALSE(html.is_empty());
}

TEST(Html, TablesAlignNumbers) {
    Table table({{"Name"}, {"Value", Table::Column::numbers}});
    EXPECT_TRUE(table.is_empty());
    table.add({text("a<b"), text("1.5")});
    EXPECT_FALSE(table.is_empty());
    EXPECT_EQ(table.html().markup(),
              "<table class=\"\"><thead><tr><th class=\"words\">Name</th><th class=\"number\">Value</th></tr>"
              "</thead>\n<tbody><tr><td class=\"words\">a&lt;b</td><td class=\"number\">1.5</td></tr>\n"
              "</tbody></table>");
    EXPECT_THROW(table.add({text("a"), text("b"), text("c")}), std::out_of_range);
}

}  // namespace
}  // namespace stilb::report
