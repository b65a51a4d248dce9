// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/model_files.hpp"

#include "files/xml_element.hpp"

#include <map>
#include <string>

namespace cortex {

// `paths`: where each path, and each cluster, stands that was read so far.
void readCluster(const XmlElement& element, const std::string& file, SystemDescription& system,
                 std::map<std::string, Place>& paths, Report& report);
void readSimplex(const XmlElement& element, const std::string& file, SystemDescription& system,
                 std::map<std::string, Place>& paths, Report& report);

}  // namespace cortex
