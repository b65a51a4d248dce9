// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTextBrowser>

namespace cortex::gui {

// The page docs/explorer.md, which is built in. A widget names the section about itself and what
// lies in it with helpOf(); F1 opens the page there.
class ManualView : public QTextBrowser {
    Q_OBJECT
public:
    explicit ManualView(QWidget* parent = nullptr);

    bool openAt(const QString& section);  // false: the page has no such section
    QString section() const;              // the one that was opened last
    QStringList sections() const;
    void restyle();

    static void helpOf(QWidget& widget, const QString& section);
    static QString sectionOf(const QWidget* widget);  // of it, or of the nearest around it

private:
    QString section_;
};

}  // namespace cortex::gui
