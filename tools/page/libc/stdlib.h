/// Numbers from text, read by the browser (libc.mjs).
#pragma once

__attribute__((import_name("strtod"))) double strtod(const char *text,
                                                     char **end);
float strtof(const char *text, char **end); // of builds in float alone
// Of sources of the command line, by functions that the page does not call.
void *realloc(void *block, __SIZE_TYPE__ size);
void free(void *block);
