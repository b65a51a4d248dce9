// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"
#include "model/overview.hpp"
#include "model/state_times.hpp"

#include <QString>
#include <cstddef>
#include <string>

// What the first page says of what is wrong.
namespace cortex::gui {

// Path, and what is wrong with it: Fault, outside of limits, lost, claimed twice. Of a lost agent
// one stands for all; of more than so many of a kind the last row says how many there are.
inline constexpr std::size_t mostWrongOfAKind = 100;
OverviewRows wrongRows(const Frame& frame, const Abnormal& abnormal, const StateTimes& times);
// What is said in the place of a row that is there no more, where it is kept.
QString wrongIsOver(const Frame& frame, const std::string& key);
// "1 in Fault, 2 outside limits, 34 lost, 5 claimed twice"; empty: nothing is wrong.
QString wrongCount(const Frame& frame, const Abnormal& abnormal);

}  // namespace cortex::gui
