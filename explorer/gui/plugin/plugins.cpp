// SPDX-License-Identifier: Apache-2.0
#include "plugin/plugins.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QLibrary>
#include <algorithm>

namespace cortex::gui {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("Plugins", text); }

QStringList folders() {
    QStringList result =
        qEnvironmentVariable("CORTEX_EXPLORER_PLUGINS").split(':', Qt::SkipEmptyParts);
    result << QDir::homePath() + QStringLiteral("/.local/lib/cortex/explorer");
    result << QCoreApplication::applicationDirPath() + QStringLiteral("/../lib/cortex/explorer");
    return result;
}

}  // namespace

Plugins& Plugins::all() {
    static Plugins plugins{folders()};
    return plugins;
}

Plugins::Plugins(const QStringList& folders) {
    for (const QString& folder : folders) {
        const QDir files{folder, QStringLiteral("*.so"), QDir::Name, QDir::Files};
        for (const QString& file : files.entryList()) load(files.absoluteFilePath(file));
    }
}

void Plugins::load(const QString& file) {
    QLibrary library{file};
    library.setLoadHints(QLibrary::ResolveAllSymbolsHint);
    using Entry = const Plugin* (*)();
    const auto entry = reinterpret_cast<Entry>(library.resolve("cortexExplorerPlugin"));
    if (entry == nullptr) {
        problems_ << tr("%1 was not loaded: %2").arg(file, library.errorString());
        return;
    }
    const Plugin* plugin = entry();
    if (plugin == nullptr || plugin->api != Plugin::current) {
        problems_ << tr("%1 was not loaded: it was built for version %2 of the interface, and this "
                        "is %3. Build it again.")
                         .arg(file)
                         .arg(plugin == nullptr ? 0 : plugin->api)
                         .arg(Plugin::current);
        return;
    }
    add(*plugin);
}

void Plugins::add(const Plugin& plugin) {
    for (std::size_t i = 0; i < plugin.count; ++i) {
        if (std::ranges::find(views_, &plugin.views[i]) == views_.end())
            views_.push_back(&plugin.views[i]);
    }
}

std::vector<const ViewType*> Plugins::ofSystem() const {
    std::vector<const ViewType*> found;
    for (const ViewType* each : views_) {
        if (*each->forType == '\0') found.push_back(each);
    }
    return found;
}

const ViewType* Plugins::viewFor(const Type& type, const TypeModel& types) const {
    if (views_.empty()) return nullptr;
    std::vector<const Type*> level{&type};
    while (!level.empty()) {  // nearest first, then by the order of parents
        std::vector<const Type*> next;
        for (const Type* each : level) {
            const auto found = std::ranges::find_if(
                views_, [&](const ViewType* view) { return view->forType == each->name; });
            if (found != views_.end()) return *found;
            for (const std::string& parent : each->parents) {
                const Type* known = types.find(parent);
                if (known != nullptr && std::ranges::find(next, known) == next.end()) {
                    next.push_back(known);
                }
            }
        }
        level = std::move(next);
    }
    return nullptr;
}

}  // namespace cortex::gui
