#if defined(_WIN32)

#define WIN32_LEAN_AND_MEAN
#include <io.h>
#include <windows.h>

#include <cerrno>

#include "lib/base/system.hpp"

namespace powercell::system {
namespace {

namespace fs = std::filesystem;

constexpr int quota_exceeded = 1295;  // ERROR_DISK_QUOTA_EXCEEDED, which MinGW's headers lack

std::error_code reason(DWORD error) {
  return {static_cast<int>(error), std::system_category()};
}

/// Closes what it has, where the system said so at the place of its error.
struct Handle {
  HANDLE handle;
  ~Handle() {
    if (is_open()) CloseHandle(handle);
  }
  bool is_open() const { return handle != nullptr && handle != INVALID_HANDLE_VALUE; }
};

}  // namespace

std::string process_number() {
  return std::to_string(GetCurrentProcessId());
}

fs::path path_from_environment(const char* variable) {
  const wchar_t* const value = _wgetenv(fs::path(variable).c_str());
  return value ? value : L"";
}

fs::path cache_folder() {
  return path_from_environment("LOCALAPPDATA");
}

std::FILE* create_file(const fs::path& path, std::error_code& error) {
  std::FILE* const file = _wfopen(path.c_str(), L"wbN");
  error = {file ? 0 : errno, std::generic_category()};
  return file;
}

void write_to_disk(std::FILE* file, std::error_code& error) {
  error = {std::fflush(file) == 0 && _commit(_fileno(file)) == 0 ? 0 : errno, std::generic_category()};
}

bool is_full(const std::error_code& error) {
  return error == std::errc::no_space_on_device ||
         (error.category() == std::system_category() && error.value() == quota_exceeded);
}

std::span<const std::byte> map_file(const fs::path& path, std::error_code& error) {
  error.clear();
  const auto fail = [&] {
    error = reason(GetLastError());
    return std::span<const std::byte>();
  };
  constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const Handle file{CreateFileW(path.c_str(), GENERIC_READ, shared, nullptr, OPEN_EXISTING,
                                FILE_ATTRIBUTE_NORMAL, nullptr)};
  LARGE_INTEGER bytes{};
  if (!file.is_open() || !GetFileSizeEx(file.handle, &bytes)) return fail();
  if (bytes.QuadPart == 0) return {};  // which cannot be mapped
  const Handle mapping{CreateFileMappingW(file.handle, nullptr, PAGE_READONLY, 0, 0, nullptr)};
  if (!mapping.is_open()) return fail();
  const void* const data = MapViewOfFile(mapping.handle, FILE_MAP_READ, 0, 0, 0);
  if (data == nullptr) return fail();
  return {static_cast<const std::byte*>(data), static_cast<std::size_t>(bytes.QuadPart)};
}

void unmap(std::span<const std::byte> bytes) noexcept {
  if (!bytes.empty()) UnmapViewOfFile(bytes.data());
}

void drop(std::span<const std::byte> bytes) noexcept {
  // Of pages that are not locked it says so, and takes them from the process.
  if (!bytes.empty()) (void)VirtualUnlock(const_cast<std::byte*>(bytes.data()), bytes.size());
}

bool FileLock::take(const fs::path& path, std::error_code& error) {
  release();
  error.clear();
  // Open for nobody else.
  const HANDLE file = CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_ALWAYS,
                                  FILE_ATTRIBUTE_NORMAL, nullptr);
  if (file == INVALID_HANDLE_VALUE) {
    if (const DWORD code = GetLastError(); code != ERROR_SHARING_VIOLATION) error = reason(code);
    return false;
  }
  handle_ = reinterpret_cast<std::intptr_t>(file);
  return true;
}

void FileLock::release() noexcept {
  if (handle_ != -1) CloseHandle(reinterpret_cast<HANDLE>(handle_));
  handle_ = -1;
}

}  // namespace powercell::system

#endif
