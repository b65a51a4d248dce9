// SPDX-License-Identifier: Apache-2.0
#include "window/layouts.hpp"

#include "model/whole_file.hpp"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QRegularExpression>
#include <QStandardPaths>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int version = 1;
constexpr qint64 longest = 1'000'000;  // bytes

QString inLayouts(const char* text) { return QCoreApplication::translate("Layouts", text); }

QString field(const char* name) { return QLatin1String{name}; }

QString nameOf(int domain, const QStringList& agents) {
    QStringList sorted = agents;
    sorted.sort();
    const QByteArray hash =
        QCryptographicHash::hash(sorted.join('\n').toUtf8(), QCryptographicHash::Sha256).toHex();
    return QStringLiteral("domain-%1-%2.json").arg(domain).arg(QString::fromLatin1(hash.left(12)));
}

// The program saves it by itself; any other name is one of the user.
bool isOwn(const QString& file) {
    static const QRegularExpression own{QStringLiteral("^domain-[0-9]+-[0-9a-f]{12}\\.json$")};
    return own.match(file).hasMatch();
}

// What is wrong with the text of a layout; empty: nothing.
QString troubleOf(const QJsonDocument& document, const QJsonParseError& error) {
    if (error.error != QJsonParseError::NoError) {
        return inLayouts("it is no JSON: %1 at byte %2").arg(error.errorString()).arg(error.offset);
    }
    const QJsonObject root = document.object();
    const int found = root[field("version")].toInt();
    if (found != version)
        return inLayouts("it has version %1, and this program reads %2").arg(found).arg(version);
    if (!root[field("layout")].isObject()) return inLayouts("it has no layout");
    return {};
}

std::optional<QJsonObject> layoutIn(const QString& name, QString& trouble) {
    QFile file{name};
    if (!file.open(QIODevice::ReadOnly)) {
        trouble = file.errorString();
        return std::nullopt;
    }
    if (file.size() > longest) {
        trouble = inLayouts("it is longer than 1 MB");
        return std::nullopt;
    }
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(file.readAll(), &error);
    trouble = troubleOf(document, error);
    if (!trouble.isEmpty()) return std::nullopt;
    return document.object()[field("layout")].toObject();
}

}  // namespace

Layouts::Layouts(QString folder) : folder_{std::move(folder)} {}

QString Layouts::usualFolder() {
    return QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation) +
           QStringLiteral("/cortex/explorer/layouts");
}

std::optional<QJsonObject> Layouts::newest(int domain) {
    const QDir files{folder_, QStringLiteral("domain-%1-*.json").arg(domain), QDir::Time,
                     QDir::Files};
    for (const QString& each : files.entryList()) {
        if (!isOwn(each)) continue;
        if (auto layout = readOwn(files.filePath(each))) return layout;
    }
    return std::nullopt;
}

QStringList Layouts::named() const {
    const QDir files{folder_, QStringLiteral("*.json"), QDir::Name | QDir::IgnoreCase, QDir::Files};
    QStringList all;
    for (const QString& each : files.entryList()) {
        if (!isOwn(each)) all << files.filePath(each);
    }
    return all;
}

QString Layouts::folder() const {
    QDir{}.mkpath(folder_);
    return folder_;
}

std::optional<QJsonObject> Layouts::of(int domain, const QStringList& agents) {
    const QString file = folder_ + '/' + nameOf(domain, agents);
    return QFile::exists(file) ? readOwn(file) : std::nullopt;
}

std::optional<QJsonObject> Layouts::read(const QString& name) {
    QString trouble;
    auto layout = layoutIn(name, trouble);
    if (!layout) troubles_ << inLayouts("The layout %1 cannot be used: %2.").arg(name, trouble);
    return layout;
}

std::optional<QJsonObject> Layouts::readOwn(const QString& name) {
    QString trouble;
    auto layout = layoutIn(name, trouble);
    if (layout) return layout;
    QString aside = name + QStringLiteral(".broken");
    for (int i = 2; QFile::exists(aside); ++i) aside = name + QStringLiteral(".broken-%1").arg(i);
    const bool moved = QFile::rename(name, aside);
    troubles_ << (moved ? inLayouts("The saved layout cannot be used: %1. It was set aside as %2.")
                              .arg(trouble, aside)
                        : inLayouts("The layout %1 cannot be used: %2. It could not be set aside; "
                                    "move it away.")
                              .arg(name, trouble));
    return std::nullopt;
}

QString Layouts::save(int domain, const QStringList& agents, const QJsonObject& layout) const {
    if (!QDir{}.mkpath(folder_)) return inLayouts("the folder %1 cannot be made").arg(folder_);
    return write(folder_ + '/' + nameOf(domain, agents), domain, agents, layout);
}

QString Layouts::write(const QString& name, int domain, const QStringList& agents,
                       const QJsonObject& layout) {
    const QJsonObject root{{field("version"), version},
                           {field("domain"), domain},
                           {field("agents"), QJsonArray::fromStringList(agents)},
                           {field("layout"), layout}};
    return writeWholeFile(name, QJsonDocument{root}.toJson());
}

QStringList Layouts::takeTroubles() { return std::exchange(troubles_, {}); }

}  // namespace cortex::gui
