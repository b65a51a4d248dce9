// SPDX-License-Identifier: Apache-2.0
#include "views/run_question.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "widgets/question.hpp"

#include <QCoreApplication>
#include <QTimer>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int lookAgain = 100;  // ms

QString say(const char* text) { return QCoreApplication::translate("RunQuestion", text); }

// On a button; it is whole in the title.
QString onButton(const QString& name) {
    constexpr int mostLetters = 40;
    return name.size() > mostLetters ? name.left(mostLetters) + QStringLiteral("…") : name;
}

// "speed = 0.5 m/s", at full precision.
QString argumentText(const DataItem& item, const Value& value) {
    QString text = plainText(item.name) + QStringLiteral(" = ") +
                   plainText(entryText(item, value).toStdString());
    if (!item.unit.empty()) text += ' ' + plainText(unitText(item.unit).toStdString());
    return text;
}

// In the order of the form; also what the agent takes for those that were left empty.
QStringList linesOf(const RunQuestion& question) {
    QStringList lines;
    if (!question.command.description.empty()) lines << plainText(question.command.description);
    for (const DataItem& item : question.command.request) {
        const auto given = question.arguments.find(item.name);
        if (given != question.arguments.end())
            lines << argumentText(item, given->second);
        else if (item.hasDefault)
            lines << say("%1 (default)").arg(argumentText(item, item.initial));
    }
    return lines;
}

// Who was asked about is not who would run it.
QString whyOther(const AgentStart& asked, const AgentStart& now, const std::string& path) {
    if (now == asked) return {};
    const QString agent = plainText(now.agent);
    if (now.agent.empty()) return say("%1 is not there").arg(plainText(path));
    if (now.agent == asked.agent) return say("%1 has started anew: ask again").arg(agent);
    return say("%1 has %2 now, not %3: ask again")
        .arg(agent, plainText(path), plainText(asked.agent));
}

}  // namespace

Question& askToRun(QWidget& asker, const QWidget& button, RunQuestion question) {
    const QString name = plainText(question.command.name), path = plainText(question.path);
    const AgentStart of = question.owner();
    auto* asked =
        new Question{{say("%1 on %2 of %3?").arg(name, path, plainText(of.agent)),
                      linesOf(question), say("Run %1").arg(onButton(name)), say("Cancel")},
                     &asker};
    const auto whyNot = [of, path = question.path, owner = std::move(question.owner),
                         why = std::move(question.whyNot)] {
        const QString other = whyOther(of, owner(), path);
        return other.isEmpty() ? why() : other;
    };
    auto* look = new QTimer{asked};
    QObject::connect(look, &QTimer::timeout, asked, [asked, whyNot] { asked->refuse(whyNot()); });
    look->start(lookAgain);
    QObject::connect(asked, &Question::pressed, &asker,
                     [asked, whyNot, yes = std::move(question.yes)] {
                         const QString why = whyNot();
                         asked->refuse(why);
                         if (!why.isEmpty()) return;
                         asked->close();
                         yes();
                     });
    asked->openBelow(button);
    return *asked;
}

}  // namespace cortex::gui
