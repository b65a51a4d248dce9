// SPDX-License-Identifier: Apache-2.0
#include "security/security_openssl.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>

#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

namespace cortex::comms {
namespace {

struct Free {
    void operator()(BIO* bio) const { BIO_free_all(bio); }
    void operator()(PKCS7* message) const { PKCS7_free(message); }
    void operator()(X509_NAME* name) const { X509_NAME_free(name); }
    void operator()(X509_EXTENSION* extension) const { X509_EXTENSION_free(extension); }
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
    void operator()(STACK_OF(X509) * certificates) const { sk_X509_free(certificates); }
    void operator()(ASN1_TIME* time) const { ASN1_TIME_free(time); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

constexpr int signFlags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_NOSMIMECAP;
constexpr std::time_t skew = 3600;  // by which the clocks of two machines may differ

void require(bool done, const char* what) {
    if (done) return;
    std::array<char, 256> reason{};
    ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
    ERR_clear_error();
    throw Error{std::string{"OpenSSL cannot make "} + what + ": " + reason.data()};
}

Owned<BIO> reader(const std::string& text) {
    return Owned<BIO>{BIO_new_mem_buf(text.data(), static_cast<int>(text.size()))};
}

Owned<BIO> writer() { return Owned<BIO>{BIO_new(BIO_s_mem())}; }

std::string contentOf(BIO* bio) {
    char* data = nullptr;
    const long size = BIO_get_mem_data(bio, &data);
    return {data, static_cast<std::size_t>(size)};
}

Owned<X509_NAME> nameOf(const std::string& name) {
    Owned<X509_NAME> subject{X509_NAME_new()};
    const auto add = [&](const char* field, const std::string& value) {
        const auto* octets = reinterpret_cast<const unsigned char*>(value.data());
        return X509_NAME_add_entry_by_txt(subject.get(), field, MBSTRING_UTF8, octets,
                                          static_cast<int>(value.size()), -1, 0) == 1;
    };
    require(subject && add("O", "CorteX") && add("CN", name), "a name");
    return subject;
}

void addExtension(X509* certificate, int kind, const char* value) {
    const Owned<X509_EXTENSION> extension{X509V3_EXT_conf_nid(nullptr, nullptr, kind, value)};
    require(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "a certificate");
}

std::time_t timeOf(const ASN1_TIME* time) {
    std::tm fields{};
    if (ASN1_TIME_to_tm(time, &fields) != 1) return 0;
    return timegm(&fields);
}

}  // namespace

void FreeOpenSsl::operator()(X509* certificate) const { X509_free(certificate); }
void FreeOpenSsl::operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }

Key newKey() {
    Key key{EVP_EC_gen("P-256")};
    require(key != nullptr, "a key");
    return key;
}

Certificate newCertificate(const std::string& name, const EVP_PKEY* key, X509* issuer,
                           EVP_PKEY* issuerKey, std::time_t until) {
    Certificate made{X509_new()};
    const Owned<X509_NAME> subject = nameOf(name);
    std::array<unsigned char, 8> serial{};
    require(made && RAND_bytes(serial.data(), serial.size()) == 1, "a certificate");
    std::uint64_t number = 0;
    for (const unsigned char octet : serial) number = number << 8 | octet;
    X509* certificate = made.get();
    const X509_NAME* by = issuer != nullptr ? X509_get_subject_name(issuer) : subject.get();
    bool done = X509_set_version(certificate, X509_VERSION_3) == 1;
    done = done && ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), number >> 1) == 1;
    done = done && X509_set_subject_name(certificate, subject.get()) == 1;
    done = done && X509_set_issuer_name(certificate, by) == 1;
    done = done && X509_set_pubkey(certificate, const_cast<EVP_PKEY*>(key)) == 1;
    done = done && ASN1_TIME_set(X509_getm_notBefore(certificate), std::time(nullptr) - skew);
    done = done && ASN1_TIME_set(X509_getm_notAfter(certificate), until);
    require(done, "a certificate");
    const bool authority = issuer == nullptr;
    addExtension(certificate, NID_basic_constraints,
                 authority ? "critical,CA:TRUE" : "critical,CA:FALSE");
    // Without digitalSignature Fast DDS refuses what an authority for permissions has signed.
    addExtension(
        certificate, NID_key_usage,
        authority ? "critical,digitalSignature,keyCertSign,cRLSign" : "critical,digitalSignature");
    require(X509_sign(certificate, issuerKey, EVP_sha256()) > 0, "a certificate");
    return made;
}

std::string pemOf(const X509* certificate) {
    const Owned<BIO> out = writer();
    require(out && PEM_write_bio_X509(out.get(), const_cast<X509*>(certificate)) == 1, "a file");
    return contentOf(out.get());
}

std::string pemOf(const EVP_PKEY* key) {
    const Owned<BIO> out = writer();
    require(out && PEM_write_bio_PKCS8PrivateKey(out.get(), key, nullptr, nullptr, 0, nullptr,
                                                 nullptr) == 1,
            "a file");
    return contentOf(out.get());
}

Certificate certificateFrom(const std::string& pem) {
    const Owned<BIO> in = reader(pem);
    Certificate certificate{PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr)};
    ERR_clear_error();
    return certificate;
}

Key keyFrom(const std::string& pem) {
    char noPassword[] = "";  // otherwise OpenSSL asks at the terminal
    const Owned<BIO> in = reader(pem);
    Key key{PEM_read_bio_PrivateKey(in.get(), nullptr, nullptr, noPassword)};
    ERR_clear_error();
    return key;
}

std::string signedText(const std::string& text, X509* signer, EVP_PKEY* key) {
    const Owned<BIO> in = reader(text), out = writer();
    const Owned<PKCS7> message{PKCS7_sign(signer, key, nullptr, in.get(), signFlags)};
    require(message != nullptr, "a signature");
    const Owned<BIO> again = reader(text);
    require(SMIME_write_PKCS7(out.get(), message.get(), again.get(), signFlags) == 1,
            "a signature");
    return contentOf(out.get());
}

std::optional<std::string> verifiedText(const std::string& smime, X509* signer) {
    const Owned<BIO> in = reader(smime), out = writer();
    BIO* content = nullptr;
    const Owned<PKCS7> message{SMIME_read_PKCS7(in.get(), &content)};
    const Owned<BIO> text{content};
    const Owned<STACK_OF(X509)> signers{sk_X509_new_null()};
    bool verified = message && text && sk_X509_push(signers.get(), signer) > 0;
    // The certificates in the message are ignored, and the signer needs no other authority.
    verified =
        verified && PKCS7_verify(message.get(), signers.get(), nullptr, text.get(), out.get(),
                                 PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN | PKCS7_NOCHAIN) == 1;
    ERR_clear_error();
    if (!verified) return {};
    return contentOf(out.get());
}

bool isIssuedBy(X509* certificate, X509* issuer) {
    const bool issued = X509_check_issued(issuer, certificate) == X509_V_OK &&
                        X509_verify(certificate, X509_get0_pubkey(issuer)) == 1;
    ERR_clear_error();
    return issued;
}

bool isKeyOf(const EVP_PKEY* key, const X509* certificate) {
    const bool fits = X509_check_private_key(const_cast<X509*>(certificate), key) == 1;
    ERR_clear_error();
    return fits;
}

std::time_t beginOf(const X509* certificate) { return timeOf(X509_get0_notBefore(certificate)); }
std::time_t endOf(const X509* certificate) { return timeOf(X509_get0_notAfter(certificate)); }

std::string commonName(const X509* certificate) {
    std::array<char, 256> text{};
    X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, text.data(),
                              static_cast<int>(text.size()));
    return text.data();
}

std::string subjectOf(const X509* certificate) {
    const Owned<BIO> out = writer();
    X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate), 0,
                       XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB);
    return contentOf(out.get());
}

std::array<std::uint8_t, 32> subjectDigest(const std::string& name) {
    std::array<std::uint8_t, 32> digest{};
    unsigned int size = 0;
    const Owned<X509_NAME> subject = nameOf(name);
    require(X509_NAME_digest(subject.get(), EVP_sha256(), digest.data(), &size) == 1, "a digest");
    return digest;
}

std::string publicText(const EVP_PKEY* key) {
    unsigned char* octets = nullptr;
    const int size = i2d_PUBKEY(key, &octets);
    require(size > 0, "a file");
    const std::string text = base64({octets, static_cast<std::size_t>(size)});
    OPENSSL_free(octets);
    return text;
}

Key keyFromPublicText(const std::string& text) {
    const auto octets = fromBase64(text);
    if (!octets) return {};
    const unsigned char* position = octets->data();
    Key key{d2i_PUBKEY(nullptr, &position, static_cast<long>(octets->size()))};
    ERR_clear_error();
    return key;
}

std::string base64(std::span<const std::uint8_t> octets) {
    std::string text(4 * ((octets.size() + 2) / 3) + 1, '\0');
    const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), octets.data(),
                                     static_cast<int>(octets.size()));
    text.resize(static_cast<std::size_t>(size));
    return text;
}

std::optional<Octets> fromBase64(const std::string& text) {
    if (text.empty() || text.size() % 4 != 0 || text.size() > 65'536) return {};
    Octets octets(text.size() / 4 * 3);
    const int size =
        EVP_DecodeBlock(octets.data(), reinterpret_cast<const unsigned char*>(text.data()),
                        static_cast<int>(text.size()));
    ERR_clear_error();
    if (size < 0) return {};
    const auto padding = static_cast<std::size_t>(std::count(text.end() - 2, text.end(), '='));
    octets.resize(octets.size() - padding);
    return octets;
}

std::string signatureOf(std::span<const std::uint8_t> octets, EVP_PKEY* key) {
    const Owned<EVP_MD_CTX> context{EVP_MD_CTX_new()};
    std::size_t size = 0;
    bool done = EVP_DigestSignInit(context.get(), nullptr, EVP_sha256(), nullptr, key) == 1;
    done = done && EVP_DigestSign(context.get(), nullptr, &size, octets.data(), octets.size()) == 1;
    Octets signature(size);
    done = done && EVP_DigestSign(context.get(), signature.data(), &size, octets.data(),
                                  octets.size()) == 1;
    require(done, "a signature");
    signature.resize(size);
    return base64(signature);
}

bool isSignature(const std::string& signature, std::span<const std::uint8_t> octets,
                 EVP_PKEY* key) {
    const auto claimed = fromBase64(signature);
    if (!claimed) return false;
    const Owned<EVP_MD_CTX> context{EVP_MD_CTX_new()};
    const bool verified =
        EVP_DigestVerifyInit(context.get(), nullptr, EVP_sha256(), nullptr, key) == 1 &&
        EVP_DigestVerify(context.get(), claimed->data(), claimed->size(), octets.data(),
                         octets.size()) == 1;
    ERR_clear_error();
    return verified;
}

}  // namespace cortex::comms
