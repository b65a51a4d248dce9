// SPDX-License-Identifier: Apache-2.0
#include "cortex/explorer/view.hpp"

extern "C" const cortex::explorer::Plugin* cortexExplorerPlugin();

const cortex::explorer::Plugin* cortexExplorerPlugin() {
    static const cortex::explorer::Plugin plugin{cortex::explorer::Plugin::current + 1};
    return &plugin;
}
