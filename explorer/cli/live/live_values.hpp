// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/core/command.hpp"
#include "cortex/core/program_interface.hpp"

#include "common/image_items.hpp"
#include "common/utc_text.hpp"
#include "text/output.hpp"

#include <optional>
#include <string>
#include <vector>

// Values of agents as people and programs read them, and as people write them.
namespace cortex::cli {

Json valueJson(const DataItem& item, const Value& value);  // a scalar, or a list
Json labelJson(const DataItem& item, const Value& value);  // label or list; null without labels
Json numberJson(const std::optional<Number>& number);      // null without one
// For people: labels, and numbers with the digits that are worth reading.
std::string valueText(const DataItem& item, const Value& value);
// For files: labels, and numbers whole unless the item has a format.
std::string exactText(const DataItem& item, const Value& value);
std::string plainText(const DataItem& item, const Value& value);  // the same without labels
// What is behind a value that is out of its range: "  <- above 2", "  <- none of its labels".
std::string wrongText(const DataItem& item, const Value& value);

// Whether its values came from an agent that is still heard; otherwise they are the last ones.
bool isLive(const comms::AgentImage& image, std::uint32_t simplex);
using common::stateOf;

// "name=value" for parameters of a command or items of `set`; throws Failure with what is valid.
ProgramInterface::Arguments parseArguments(const std::string& what, const RecordLayout& request,
                                           const std::vector<std::string>& texts);

// A cell of CSV. Only to a terminal are its control characters escaped: there they would act.
std::string csvText(const std::string& text);

}  // namespace cortex::cli
