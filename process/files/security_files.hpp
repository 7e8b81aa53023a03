// Names of the files with which a process takes part in a secured fleet (`skein run --secure`), all in one folder of
// its own. They are those of an enclave of ROS 2's SROS2, so that a ROS 2 node finds its way too.
#pragma once

#include <array>

namespace skein::security_files {

inline constexpr const char* kIdentityCa = "identity_ca.cert.pem";        ///< who vouches for certificates
inline constexpr const char* kCertificate = "cert.pem";                   ///< who the process is
inline constexpr const char* kKey = "key.pem";                            ///< its private key
inline constexpr const char* kPermissionsCa = "permissions_ca.cert.pem";  ///< who signs the two that follow
inline constexpr const char* kGovernance = "governance.p7s";              ///< what is protected, and how
inline constexpr const char* kPermissions = "permissions.p7s";            ///< what the process may do, and where

inline constexpr std::array kAll = {kIdentityCa, kCertificate, kKey, kPermissionsCa, kGovernance, kPermissions};

}  // namespace skein::security_files
