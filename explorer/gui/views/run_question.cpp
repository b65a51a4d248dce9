// SPDX-License-Identifier: Apache-2.0
#include "views/run_question.hpp"

#include <QCoreApplication>
#include <QMessageBox>
#include <QPushButton>
#include <utility>

namespace cortex::gui {

namespace {

QString say(const char* text) { return QCoreApplication::translate("RunQuestion", text); }

}  // namespace

// Cancel has the focus, so that Enter does not run it.
void askToRun(QWidget* asker, const std::string& path, const Command& command,
              const comms::Mirror::Arguments& arguments, std::function<void()> yes) {
    auto* question = new QMessageBox{asker};
    question->setAttribute(Qt::WA_DeleteOnClose);
    question->setTextFormat(Qt::PlainText);
    const QString name = QString::fromStdString(command.name);
    question->setText(say("%1 on %2?").arg(name, QString::fromStdString(path)));
    QString details = QString::fromStdString(command.description);
    for (const auto& [parameter, value] : arguments) {
        details +=
            QStringLiteral("\n%1 = %2")
                .arg(QString::fromStdString(parameter), QString::fromStdString(toText(value)));
    }
    question->setInformativeText(details);
    auto* run = question->addButton(say("Run %1").arg(name), QMessageBox::AcceptRole);
    question->setDefaultButton(question->addButton(QMessageBox::Cancel));
    QObject::connect(run, &QAbstractButton::clicked, asker, std::move(yes));
    question->open();
}

}  // namespace cortex::gui
