// SPDX-License-Identifier: Apache-2.0
// What sanitizers find inside of Debian's Fast DDS 2.9 itself; nothing of ours is silenced.

// A reader is deleted there with another size than it was allocated with.
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }

extern "C" const char* __tsan_default_suppressions() {
    return "deadlock:libfastrtps.so\nmutex:libfastrtps.so\n";
}

// Certificates that it refuses are not freed there; no stack reaches further up than OpenSSL.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libcrypto.so\nleak:libfontconfig.so\n";  // fonts stay loaded until the end
}
