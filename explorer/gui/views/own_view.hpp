// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/plugins.hpp"

#include <QStackedWidget>
#include <cstdint>
#include <functional>
#include <string>

namespace cortex::gui {

class TextLabel;

// A view of a plug-in in its place. If it throws it is closed, and the reason stands there.
class OwnView : public QStackedWidget {
    Q_OBJECT
public:
    explicit OwnView(explorer::Host& host, QWidget* parent = nullptr);

    void show(const ViewType& type, const std::string& path);
    void clear();
    void refresh(const Frame& frame);  // does nothing while it is hidden
    bool select(const std::string& path);
    bool settled();
    bool wantsRoom() const;  // it needs the height that the window can spare
    const std::vector<explorer::Watch>& watches() const { return watches_; }
    const ViewType* type() const { return type_; }
    QJsonObject saved();
    void restore(const QJsonObject& saved);

    // A view has the room that the window leaves it, and presses nothing else together.
    QSize sizeHint() const override { return {1, 1}; }
    QSize minimumSizeHint() const override { return {1, 1}; }
    bool hasHeightForWidth() const override { return false; }

Q_SIGNALS:
    void opened(const std::string& path);
    void selected(const std::string& path);

private:
    void guarded(const std::function<void()>& call);
    void close(const QString& why);

    explorer::Host& host_;
    const ViewType* type_ = nullptr;
    std::string path_;
    View* view_ = nullptr;
    TextLabel *title_, *text_;
    std::vector<explorer::Watch> watches_;
    std::uint64_t bound_ = 0;  // the structures of the frame that the view was bound to
};

}  // namespace cortex::gui
