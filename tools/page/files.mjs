// Files into the page and out of it.

// Gives a file to the user.
export function download(name, text) {
  const url = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

// Takes files that are chosen by a button with its field, or dropped anywhere.
export function takeFiles(button, field, use) {
  button.onclick = () => field.click();
  field.onchange = async () => {
    if (field.files.length) await use(field.files[0]);
    field.value = ''; // so that the same one can be chosen again
  };
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    if (event.dataTransfer.files.length) use(event.dataTransfer.files[0]);
  });
}
