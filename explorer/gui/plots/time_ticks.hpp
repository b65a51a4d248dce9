// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/plot_range.hpp"

#include <QList>
#include <QString>

// Marks of a time axis, in 1, 2, 5 of the natural units.
namespace cortex::gui {

double tickStep(double seconds, double most);  // so that at most so many fit into the seconds
QList<double> timeTicks(TimeSpan span, double step);
QString timeText(double seconds, double step);  // "12:14:46", "12:14:46.250"
QString momentText(double seconds);             // "12:15:06.2"
QString zoneText(double seconds);               // "UTC"; that of all these texts
QString dayText(double seconds);                // "2026-11-26"
QString dateText(TimeSpan span);                // "11-25", of its begin; empty: it is one day
QString durationText(double seconds);           // "0.70 s", "8.100 s", "12 min"

}  // namespace cortex::gui
