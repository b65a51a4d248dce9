// SPDX-License-Identifier: Apache-2.0
#include "model/gone_text.hpp"

#include "model/plain_text.hpp"
#include "model/shown_time.hpp"

#include <QCoreApplication>

namespace cortex::gui {

namespace {

QString sayGone(const char* text) { return QCoreApplication::translate("Gone", text); }

}  // namespace

QString goneText(const GoneAgent& agent) {
    const QString text =
        agent.ended ? sayGone("%1 ended at %2.") : sayGone("%1 was heard last at %2.");
    return text.arg(plainText(agent.name), timeAndZone(agent.when, "HH:mm:ss"));
}

QString goneInputText(const Frame& frame, Place place) {
    const auto input = frame.goneInput(place);
    if (!input) return {};
    return sayGone("The input %1 is gone: %2")
        .arg(QString::fromStdString(input->path), goneText(*input->agent));
}

}  // namespace cortex::gui
