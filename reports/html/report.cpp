// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/report.hpp"

#include <stdexcept>
#include <string_view>

#include "reports/html/page_data.hpp"
#include "reports/html/resources.hpp"

namespace sphverify {

namespace {

std::string escaped(std::string_view text) {
  std::string html;
  for (char const c : text) {
    switch (c) {
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '&':
        html += "&amp;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

/// JSON that cannot end the script element it stands in: "<" occurs in strings alone, where it may be
/// escaped.
std::string script_json(Json const& data) {
  std::string text;
  for (char const c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string title_of(std::vector<NamedResults> const& documents) {
  std::string title = "sphverify";
  for (NamedResults const& document : documents) title += " · " + document.name;
  return title;
}

}  // namespace

bool can_write_page() {
  return !page_resource("node_modules/d3/dist/d3.min.js").empty() &&
         !page_resource("node_modules/@observablehq/plot/dist/plot.umd.min.js").empty();
}

std::string report_page(std::vector<NamedResults> const& documents, std::set<std::string> const& controls) {
  if (!can_write_page()) {
    throw std::runtime_error(
        "report: built without the plotting library: run tools/install-packages, or "
        "`npm ci --ignore-scripts` in reports/page, and build again");
  }
  // What is put in is not looked through again: names in braces may stand in the data.
  std::string page;
  std::string_view rest = page_resource("page.html");
  for (std::size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    std::size_t const close = rest.find("}}", open);
    std::string_view const name = rest.substr(open + 2, close - open - 2);
    page += rest.substr(0, open);
    if (name == "title") {
      page += escaped(title_of(documents));
    } else if (name == "data") {
      page += script_json(page_data(documents, controls));
    } else if (name == "licences") {
      page += escaped(page_resource(name));
    } else {
      page += page_resource(name);
    }
    rest.remove_prefix(close + 2);
  }
  return page.append(rest);
}

}  // namespace sphverify
