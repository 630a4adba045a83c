#include "xml_writer.hpp"

#include <algorithm>
#include <cmath>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

std::string spaced(std::initializer_list<double> numbers) {
  std::string text;
  for (const double x : numbers) {
    if (!text.empty()) text += ' ';
    text += shortest(x);
  }
  return text;
}
std::string spaced(const Vec3& v) { return spaced({v.x(), v.y(), v.z()}); }
std::string spaced(const Quat& q) { return spaced({q.w(), q.x(), q.y(), q.z()}); }

std::string spaced_rpy(const Quat& q) {
  const Mat3 r = q.toRotationMatrix();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2)));
  // At a pitch of a quarter turn roll and yaw turn about one axis: all of it is called yaw.
  if (std::hypot(r(2, 1), r(2, 2)) < 1e-12) return spaced({0, pitch, std::atan2(-r(0, 1), r(1, 1))});
  return spaced({std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))});
}

Xml& child(Xml& parent, const char* tag) { return *parent.InsertNewChildElement(tag); }
Xml& child(Xml& parent, const char* tag, const std::string& text) {
  Xml& element = child(parent, tag);
  element.SetText(text.c_str());
  return element;
}
void set(Xml& element, const char* attribute, const std::string& value) {
  element.SetAttribute(attribute, value.c_str());
}

void add_comment(tinyxml2::XMLNode& parent, const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '-' && !safe.empty() && safe.back() == '-') safe += ' ';
    safe += c;
  }
  parent.InsertEndChild(parent.GetDocument()->NewComment((" " + safe + " ").c_str()));
}

void add_preamble(tinyxml2::XMLDocument& document, const std::string& format, const std::string& scenario,
                  const std::vector<std::string>& losses) {
  document.InsertEndChild(document.NewDeclaration());
  std::string text = scenario + " as " + format + ", written by plumbline export.";
  text += losses.empty() ? " Nothing was lost." : "\n     Not in this file:";
  for (const std::string& loss : losses) text += "\n     * " + loss;
  add_comment(document, text);
}

std::string printed(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace plumbline
