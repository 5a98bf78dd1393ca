/* SANITIZED where a sanitizer watches: memory is not limited there, and time says nothing. */
#ifndef LOM_TESTS_SANITIZED_H
#define LOM_TESTS_SANITIZED_H

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || defined __SANITIZE_UNDEFINED__
#define SANITIZED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(undefined_behavior_sanitizer) || __has_feature(memory_sanitizer)
#define SANITIZED 1
#endif
#endif

#endif
