// SPDX-License-Identifier: Apache-2.0
#pragma once

class QMenu;

namespace cortex::gui {

class LayoutKeeper;

// Fills a menu with what becomes of the layout, and, each time it opens, with those that the user
// has named.
void addLayout(QMenu& menu, LayoutKeeper& layout);

}  // namespace cortex::gui
