// SPDX-License-Identifier: Apache-2.0
#include "model/nothing_text.hpp"

#include "model/value_text.hpp"

#include <QCoreApplication>

namespace cortex::gui {

namespace {

QString sayNothing(const char* text, int count = -1) {
    return QCoreApplication::translate("Nothing", text, nullptr, count);
}

// Participants with security are seen only by those that have it, too.
QString whatWasLookedFor(const Frame& frame) {
    QString looked = sayNothing("Looked for %1.").arg(ageText(frame.seconds));
    if (frame.closed == 0) return looked;
    return looked + ' ' +
           sayNothing(
               "%n participants with security were found; they are seen only with a folder "
               "of their authority.",
               static_cast<int>(frame.closed));
}

}  // namespace

std::optional<NothingText> nothingText(const Frame& frame) {
    if (!frame.problem.empty())
        return NothingText{sayNothing("Domain %1 cannot be joined.").arg(frame.domain),
                           QString::fromStdString(frame.problem)};
    if (!frame.joined) {
        const QString security = QString::fromStdString(frame.security);
        return NothingText{
            sayNothing("Joining domain %1…").arg(frame.domain),
            security.isEmpty() ? QString{} : sayNothing("Security: reading %1.").arg(security)};
    }
    if (!frame.agents.empty()) return std::nullopt;
    return NothingText{sayNothing("Nobody is heard in domain %1.").arg(frame.domain),
                       whatWasLookedFor(frame)};
}

}  // namespace cortex::gui
