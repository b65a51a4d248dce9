// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cortex::test {

// A domain of DDS, 1 to 99, that nobody on this machine uses: no port of it is bound, and no other
// test has locked its file, as this process does until it ends. The same at each call of a process.
// Ports of these domains are below those that the system hands out.
int ownDomain();
int secondDomain();  // another one

}  // namespace cortex::test
