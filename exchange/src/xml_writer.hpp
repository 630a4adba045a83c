// tinyxml2 with our numbers: shortest decimals that read back as the same double, vectors with spaces between.
#pragma once

#include <tinyxml2.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

using Xml = tinyxml2::XMLElement;

std::string spaced(std::initializer_list<double> numbers);
std::string spaced(const Vec3& v);
std::string spaced(const Quat& q);  // w x y z
// As roll, pitch and yaw: turns about the fixed axes x, y and z, in that order.
std::string spaced_rpy(const Quat& q);

// New last child; with text where some is given.
Xml& child(Xml& parent, const char* tag);
Xml& child(Xml& parent, const char* tag, const std::string& text);
void set(Xml& element, const char* attribute, const std::string& value);

// Whatever the text, the comment stays well-formed: two hyphens in a row end one in XML.
void add_comment(tinyxml2::XMLNode& parent, const std::string& text);
// Who wrote the file and what it lacks, before everything else.
void add_preamble(tinyxml2::XMLDocument& document, const std::string& format, const std::string& scenario,
                  const std::vector<std::string>& losses);
std::string printed(const tinyxml2::XMLDocument& document);

}  // namespace plumbline
