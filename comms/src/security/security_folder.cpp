// SPDX-License-Identifier: Apache-2.0
#include "security/security_folder.hpp"

#include "cortex/core/error.hpp"

#include "security/security_documents.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <sys/stat.h>
#include <unistd.h>

namespace cortex::comms {
namespace {

namespace fs = std::filesystem;
namespace files = security_files;

// Collects everything that is wrong with a folder.
class FolderCheck {
public:
    explicit FolderCheck(SecurityFolder& folder) : folder_{folder} {}

    void run();

private:
    void wrong(const std::string& text) { findings_ += "\n  " + text; }
    std::string read(const char* file);
    Certificate readCertificate(const char* file);
    void readKey();
    void checkDates(const char* file, const X509* certificate);
    void checkCertificate();
    std::string checkSigned(const char* file, const std::string& smime);
    void checkPermissions();
    void checkCommands();

    SecurityFolder& folder_;
    Certificate identityAuthority_, certificate_;
    std::string findings_;
};

std::string FolderCheck::read(const char* file) {
    if (const std::string why = changeableByOthers(folder_.folder / file); !why.empty()) wrong(why);
    try {
        return contentOf(folder_.folder / file);
    } catch (const Error& error) {
        wrong(error.what());
        return {};
    }
}

Certificate FolderCheck::readCertificate(const char* file) {
    const std::string text = read(file);
    Certificate certificate = certificateFrom(text);
    if (!certificate && !text.empty()) wrong(std::string{file} + " is no certificate");
    if (certificate) checkDates(file, certificate.get());
    return certificate;
}

void FolderCheck::readKey() {
    const std::string text = read(files::key);
    folder_.key = keyFrom(text);
    if (text.empty()) return;
    if (!folder_.key) wrong(std::string{files::key} + " is no private key without a password");
    struct stat status{};
    const fs::path file = folder_.folder / files::key;
    if (stat(file.c_str(), &status) == 0 && (status.st_mode & 077U) != 0) {
        wrong(std::string{files::key} +
              " can be read by others: whoever has it is this agent; chmod 600 " + file.string());
    }
}

void FolderCheck::checkDates(const char* file, const X509* certificate) {
    const std::time_t now = std::time(nullptr), begin = beginOf(certificate),
                      end = endOf(certificate);
    if (now > end) {
        wrong(std::string{file} + " has expired, on " + utcText(end) + "; make the folder anew");
    } else if (now < begin) {
        wrong(std::string{file} + " is valid from " + utcText(begin) + " on, and it is " +
              utcText(now) + " now; set the clock");
    }
}

void FolderCheck::checkCertificate() {
    if (!certificate_) return;
    folder_.rights.agent = commonName(certificate_.get());
    const std::string subject = "CN=" + folder_.rights.agent + ",O=CorteX";
    if (subjectOf(certificate_.get()) != subject) {
        wrong(std::string{files::certificate} + " is for '" + subjectOf(certificate_.get()) +
              "', not for an agent: CN=NAME,O=CorteX");
    }
    if (identityAuthority_ && !isIssuedBy(certificate_.get(), identityAuthority_.get())) {
        wrong(std::string{files::certificate} + " is not signed by " + files::identityAuthority);
    }
    if (folder_.key && !isKeyOf(folder_.key.get(), certificate_.get())) {
        wrong(std::string{files::key} + " is not the key of " + files::certificate);
    }
}

std::string FolderCheck::checkSigned(const char* file, const std::string& smime) {
    if (smime.empty() || !folder_.permissionsAuthority) return {};
    const auto text = verifiedText(smime, folder_.permissionsAuthority.get());
    if (!text) {
        wrong(std::string{file} + " was changed, or is not signed by " +
              files::permissionsAuthority);
    }
    return text.value_or("");
}

void FolderCheck::checkPermissions() {
    checkSigned(files::governance, read(files::governance));
    const std::string text = checkSigned(files::permissions, read(files::permissions));
    if (text.empty() || !certificate_) return;
    const std::string subject = subjectOf(certificate_.get());
    if (text.find("<subject_name>" + subject + "</subject_name>") == std::string::npos) {
        wrong(std::string{files::permissions} + " does not permit '" + subject + "' anything");
    }
}

void FolderCheck::checkCommands() {
    folder_.commands = read(files::commands);
    const std::string text = checkSigned(files::commands, folder_.commands);
    if (text.empty()) return;
    auto list = commandListFrom(text);
    if (!list) return wrong(std::string{files::commands} + " has a form that is not known");
    const std::string owner = folder_.rights.agent;
    folder_.rights = std::move(list->rights);
    if (certificate_ && folder_.rights.agent != owner) {
        wrong(std::string{files::commands} + " is that of '" + folder_.rights.agent +
              "', and the certificate that of '" + owner + "'");
    }
    if (folder_.key && publicText(folder_.key.get()) != list->key) {
        wrong(std::string{files::commands} + " names another key than " + files::key);
    }
}

void FolderCheck::run() {
    if (!fs::is_directory(folder_.folder)) {
        throw Error{"there is no security folder '" + folder_.folder.string() +
                    "'; make one: cortex security create-agent NAME"};
    }
    if (const std::string why = changeableByOthers(folder_.folder); !why.empty()) wrong(why);
    identityAuthority_ = readCertificate(files::identityAuthority);
    folder_.permissionsAuthority = readCertificate(files::permissionsAuthority);
    certificate_ = readCertificate(files::certificate);
    readKey();
    checkCertificate();
    checkPermissions();
    checkCommands();
    if (findings_.empty()) return;
    throw Error{"the security folder '" + folder_.folder.string() +
                "' cannot be used:" + findings_ +
                "\n  Mend this, or make it anew: cortex security create-agent NAME --out FOLDER"};
}

}  // namespace

SecurityFolder::SecurityFolder(const fs::path& path) : folder{fs::absolute(path)} {
    FolderCheck{*this}.run();
}

std::string changeableByOthers(const fs::path& path) {
    struct stat status{};
    if (stat(path.c_str(), &status) != 0) return {};  // whoever reads it says so
    const uid_t self = geteuid();
    if (status.st_uid != self && status.st_uid != 0) {
        return path.string() + " belongs to user " + std::to_string(status.st_uid) +
               ", and this program runs as user " + std::to_string(self) +
               ": its owner could change whom this agent trusts; chown it to that user, or to root";
    }
    if ((status.st_mode & (S_IWGRP | S_IWOTH)) == 0) return {};
    return path.string() +
           " can be written by others: they could change whom this agent trusts; chmod go-w " +
           path.string();
}

std::string contentOf(const fs::path& file) {
    std::ifstream stream{file};
    std::string text{std::istreambuf_iterator<char>{stream}, {}};
    if (!stream || text.empty()) {
        const char* why = stream ? "is empty" : std::strerror(errno);
        throw Error{file.filename().string() + ": " + why};
    }
    return text;
}

AgentRights checkSecurity(const fs::path& folder) { return SecurityFolder{folder}.rights; }

}  // namespace cortex::comms
