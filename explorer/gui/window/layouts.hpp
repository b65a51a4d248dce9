// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <optional>

namespace cortex::gui {

// The layouts that a user has: a file for each domain and set of agents. One that cannot be read is
// set aside, and never overwritten.
class Layouts {
public:
    explicit Layouts(QString folder = usualFolder());
    static QString usualFolder();  // of the user: ~/.config/cortex/explorer/layouts

    // The one that was saved last for the domain, as nobody knows yet which agents are there.
    std::optional<QJsonObject> newest(int domain);
    std::optional<QJsonObject> of(int domain, const QStringList& agents);
    std::optional<QJsonObject> read(const QString& file);  // that the user names; it stays there
    QStringList named() const;  // the files in the folder that a user has named
    QString folder() const;     // it is there
    // Empty, or why it was not saved.
    QString save(int domain, const QStringList& agents, const QJsonObject& layout) const;
    static QString write(const QString& file, int domain, const QStringList& agents,
                         const QJsonObject& layout);
    // What could not be read since the last call, a sentence each.
    QStringList takeTroubles();

private:
    std::optional<QJsonObject> readOwn(const QString& file);

    QString folder_;
    QStringList troubles_;
};

}  // namespace cortex::gui
